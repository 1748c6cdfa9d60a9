// The sunlight of a cloud's views by paths, traced once for all ways.
//
// The views of a cloud's layer, in which ways to draw it are compared with paths of light.
//
// As the views of the sky (sky_truth.h), suns, cameras and directions are points of Sobol's sequence:
// cameras even in altitude and over the tile, views even in azimuth and in elevation, as far as the layer
// is crossed within the view distance. The layer is flat.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/ext/vector_double3.hpp>
#include <vector>

#include "bakers/assets/cloud_light/cloud_layer.h"
#include "bakers/assets/cloud_light/cloud_paths.h"
#include "bakers/field/conventions.h"
#include "bakers/math/bake_options.h"
#include "config/sections/cloud.h"
#include "config/sections/scene.h"

namespace skybake {

// The suns and cameras of a scene, and the layer that they see.
struct CloudRange {
    double lowest_altitude_m = 0;
    double highest_altitude_m = 0;
    double base_m = 0;
    double height_m = 0;
    double view_distance_m = 0;
    std::vector<double> suns_deg;  // above the horizon, at azimuth 0; may be empty
    bool has_own_suns = false;     // the scene states them
};

// Returns the scene's suns above kLowestCloudSun_deg, or, of a scene that states none, up to three of its
// range: the share of clouds that is lit and how deeply depends on where the sun is.
inline constexpr double kLowestCloudSun_deg = 2;
CloudRange cloud_range(const config::Scene& scene, const Cloud& cloud);

struct CloudView {
    std::size_t sun = 0;  // its number in suns_deg
    glm::dvec3 place{};   // where the ray meets the layer or begins within, in shares of the tile
    glm::dvec3 look{};    // a unit vector, z up
};

// Returns views number `first` and following. All of them cross the layer.
std::vector<CloudView> cloud_views(const CloudRange& range, int count, std::uint32_t first);

class CloudTruth {
  public:
    // The arguments must outlive it. The sun has the irradiance 1; sky and ground are black.
    CloudTruth(const cloud_light::CloudLayer& layer, const CloudRange& range,
               std::vector<CloudView> views, const BakeOptions& options);

    // Traces the views in which the cloud covers more than a hundredth of what is behind it, with as
    // many paths each. After an interruption the light must not be used.
    void trace(double paths);

    const std::vector<CloudView>& views() const { return views_; }
    glm::dvec3 sun(const CloudView& view) const;
    const std::vector<cloud_light::TracedRadiance>& light() const { return light_; }

    // Compares the covered views as a picture shows them: a radiance L is the share 1 - exp(-k L) of
    // white, with the k that shows the ninth decile as 0.78. Sets `rms` to the root mean square without
    // the noise of paths. Where no light is seen, one value is left out.
    SkyError error(const std::vector<double>& found, double& rms) const;

  private:
    double exposure() const;
    bool is_covered(const CloudView& view) const;

    const cloud_light::CloudLayer& layer_;
    const CloudRange& range_;
    const BakeOptions& options_;
    std::vector<CloudView> views_;
    std::vector<cloud_light::TracedRadiance> light_;
    std::vector<std::size_t> covered_;
    int paths_ = 0;  // of a view
};

}  // namespace skybake
