// Clouds in front of the sky around a camera, marched as previews of clouds are (march/).
//
// The results of a march do not depend on colours, so all wavelengths share it. A texel's coefficients
// are means over its solid angle, of rays through the middles of samples x samples equal parts of it.
// The layers' x axes point straight ahead, their y axes to the left. Layers may overlap in altitude.
// Each shades the others, and what lies behind a layer is dimmed by it.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "bakers/assets/environment/environment_mapping.h"
#include "bakers/field/image.h"
#include "bakers/march/layer_march.h"
#include "bakers/march/light_in_cloud.h"
#include "bakers/math/bake_options.h"
#include "bakers/math/facts.h"
#include "config/diagnostics/diagnostic.h"
#include "config/sections/parameters.h"

namespace skybake::config {
struct EnvironmentBake;
}  // namespace skybake::config

namespace skybake {

// Returns the voxels of each layer of an environment's clouds, as the volumes' own files hold them.
// After an interruption there is neither a value nor a diagnostic.
config::Outcome<std::vector<CloudMedium>> clouds_of_environment(
    const config::Parameters& parameters, const config::EnvironmentBake& bake,
    const BakeOptions& options, Facts& details);

// Returns a direction (right, up, ahead) in the coordinates of a layer.
inline glm::dvec3 in_layer(const glm::dvec3& direction) {
    return {direction.z, -direction.x, direction.y};
}

// A layer as a texel shows it: coefficients of light sources as in RayResults.
struct SeenLayer {
    double sun_at_base = 0;
    double sun_at_top = 0;
    double from_sky = 0;
    double from_ground = 0;
    double opacity = 0;     // the share of light from the camera that ends in the layer
    double distance_m = 0;  // times the opacity
};

// All layers as a texel shows them, from the highest down.
struct SeenClouds {
    std::vector<SeenLayer> layers;
    double transmittance = 1;
};

class CloudsAround {
  public:
    // The arguments must outlive this object. Without `sunlit`, there are no marches to the sun.
    // After an interruption it must not be used.
    CloudsAround(std::span<const CloudMedium> media, const config::EnvironmentBake& bake,
                 const EnvironmentLayout& layout, bool sunlit, const BakeOptions& options);

    SeenClouds texel(int part, int column, int row) const;

    // Returns the mean over an area of a texel's size around any place, of 64 rays that no texel has,
    // with steps of half the length.
    SeenClouds around(int part, double x, double y) const;

    // Returns the transmittance of the clouds along a direction, however small.
    double transmittance(const glm::dvec3& direction) const;

    // The layers, from the highest down.
    std::span<const CloudMedium* const> media() const { return media_; }
    // The share of diffuse light that passes a layer.
    double through(std::size_t layer) const { return march_.through(layer); }
    double reach_m(double altitude_m) const;  // of the rays that go farthest

  private:
    void march_texels(int part, int row, int first, int count);

    std::vector<const CloudMedium*> media_;
    const EnvironmentLayout& layout_;
    int samples_;
    std::vector<std::optional<LightInCloud>> lights_;  // within the layers
    LayerMarch march_;
    LayerMarch finer_;
    Image2<float> seen_;  // the members of each SeenLayer, then the transmittance
};

}  // namespace skybake
