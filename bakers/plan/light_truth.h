// The views of a scene, in which ways to draw its light are compared with paths of light, and that light,
// traced once for all ways.
//
// Suns, cameras and directions are points of Sobol's sequence: suns even in elevation, cameras even in
// altitude, views even in azimuth and in the angle above the horizon, things even in distance. So a
// ninth decile is that of the pictures a scene shows, and another part of the sequence has other views
// of the same scene.
#pragma once

#include <cstdint>
#include <glm/ext/vector_double3.hpp>
#include <memory>
#include <vector>

#include "bakers/air/ray.h"
#include "bakers/assets/sky/sky_comparison.h"
#include "bakers/assets/sky/sky_samples.h"
#include "bakers/assets/sky/traced_light.h"
#include "config/sections/parameters.h"
#include "config/sections/scene.h"

namespace skybake {

// The suns and cameras of a scene, cut down to those that see a sky.
struct SceneRange {
    double lowest_altitude_km = 0;
    double highest_altitude_km = 0;  // within the air
    double lowest_sun_deg = 0;
    double highest_sun_deg = 0;
    std::vector<double> suns_deg;  // the only suns; empty: any within the bounds
    double view_distance_km = 0;
};

// Where the light is compared. For the light on the ground it is what falls on level surfaces at the
// cameras.
struct LightView {
    SkySample sky;
    double distance_km = 0;  // to a thing, for the air before it
};

// Under a lower sun the sky of Earth is a thousandth as bright as at sunset.
inline constexpr double kLowestSun_deg = -6;

// Returns the range of a recipe's scene, or of a scene that says nothing. Suns below kLowestSun_deg
// count only where the scene has no others.
SceneRange range_of(const config::Scene& scene, const Shell& shell);

// Returns the elevation of a view above the horizontal.
double elevation_deg(const Shell& shell, const SkySample& view);

// Returns a view at an angle above the horizontal; the share is that of the way to the most distant
// thing, which is at the ground or at the scene's view distance.
LightView light_view(const SceneRange& range, const Shell& shell, double altitude_km,
                     double sun_deg, double elevation_deg, double azimuth_deg, double share);

// Returns views number `first` and following. Those of the sky are above the horizon, those of things
// up to kMostTilt_deg above and below the horizontal, and those of surroundings in all directions.
inline constexpr double kMostTilt_deg = 30;
std::vector<LightView> scene_views(config::Draws light, const SceneRange& range, const Shell& shell,
                                   int count, std::uint32_t first);

class SceneTruth {
  public:
    // `weights` make colours of all wavelengths; none: their light is compared itself.
    SceneTruth(config::Draws light, const Parameters& parameters, std::vector<LightView> views,
               std::vector<glm::dvec3> weights, BakeOptions options);

    // Traces `most_paths` paths in all views together. After an interruption the light must not be used.
    void trace(double most_paths);

    config::Draws what() const { return what_; }
    const std::vector<LightView>& views() const { return views_; }
    // The air of each packet of wavelengths.
    const std::vector<std::shared_ptr<const TracedAir>>& packets() const { return packets_; }
    // Returns the channels that are compared, of light of the wavelengths.
    std::vector<Spectrum> as_compared(std::vector<Spectrum> light) const;
    // Returns the traced light of the views, as it is compared.
    std::vector<Spectrum> light() const;
    // Returns relative errors. Those of the air before things are shares of the light that the view has
    // without the thing, ground included: a thing that is near shows little air.
    SkyError error(const std::vector<Spectrum>& found) const;

  private:
    config::Draws what_;
    std::vector<LightView> views_;
    BakeOptions options_;
    std::vector<std::shared_ptr<const TracedAir>> packets_;
    std::vector<glm::dvec3> weights_;
    TracedLight light_;
    SkyComparison comparison_;
    TracedLight whole_light_;
    SkyComparison whole_;  // the views without things, which are the scale of the air before these
};

}  // namespace skybake
