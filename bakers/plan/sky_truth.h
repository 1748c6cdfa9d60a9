// The light of a scene's views by paths, traced once for all ways.
//
// The views of a scene, in which ways to draw its sky are compared with paths of light.
//
// Suns, cameras and directions are points of Sobol's sequence: suns even in elevation, cameras even in
// altitude, views even in azimuth and in the angle above the horizon. So a ninth decile is that of the
// pictures a scene shows, and another part of the sequence has other views of the same scene.
#pragma once

#include <cstdint>
#include <glm/ext/vector_double3.hpp>
#include <memory>
#include <optional>
#include <vector>

#include "bakers/air/ray.h"
#include "bakers/assets/sky/sky_comparison.h"
#include "bakers/assets/sky/sky_samples.h"
#include "bakers/assets/sky/traced_light.h"
#include "config/sections/atmosphere.h"
#include "config/sections/scene.h"

namespace skybake {

// The suns and cameras of a scene, cut down to those that see a sky.
struct SceneRange {
    double lowest_altitude_km = 0;
    double highest_altitude_km = 0;  // within the air
    double lowest_sun_deg = 0;
    double highest_sun_deg = 0;
    std::vector<double> suns_deg;  // the only suns; empty: any within the bounds
};

// Under a lower sun the sky of Earth is a thousandth as bright as at sunset.
inline constexpr double kLowestSun_deg = -6;

// Returns the range of a recipe's scene, or of a scene that says nothing. Suns below kLowestSun_deg
// count only where the scene has no others.
SceneRange range_of(const config::Scene& scene, const Shell& shell);

// Returns views number `first` and following, all of the sky above the horizon.
std::vector<SkySample> scene_views(const SceneRange& range, const Shell& shell, int count,
                                   std::uint32_t first);

class SceneTruth {
  public:
    // The air has at most four wavelengths, of which `weights` make colours; none: their light is
    // compared itself.
    SceneTruth(const config::Atmosphere& air, std::vector<SkySample> views,
               std::vector<glm::dvec3> weights, BakeOptions options);

    // Traces `most_paths` paths in all views together. After an interruption the light must not be used.
    void trace(double most_paths) { comparison_.trace(most_paths); }

    const std::vector<SkySample>& views() const { return views_; }
    const SkyMedium& medium() const { return air_->medium(); }
    const std::shared_ptr<const TracedAir>& air() const { return air_; }
    // Returns the channels that are compared, of light of the wavelengths.
    std::vector<Spectrum> as_compared(std::vector<Spectrum> light) const;
    // Returns the traced light of the views, as it is compared.
    std::vector<Spectrum> light() const;
    SkyError error(const std::vector<Spectrum>& found) const { return comparison_.error(found); }

  private:
    std::vector<SkySample> views_;
    BakeOptions options_;
    std::shared_ptr<const TracedAir> air_;
    std::vector<glm::dvec3> weights_;
    TracedLight light_;
    SkyComparison comparison_;
};

}  // namespace skybake
