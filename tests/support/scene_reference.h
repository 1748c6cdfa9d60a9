// The definition of scene_view.h along one ray, slowly and in double: all layers at the same fine steps,
// from each of them a march to the sun through all layers, and the copies of tiles by their definition.
#pragma once

#include <vector>

#include "bakers/render/scene_march.h"

namespace skybake {

// The results of one layer.
struct ReferenceLayer {
    double sun_at_base = 0;
    double sun_at_top = 0;
    double from_sky = 0;
    double from_ground = 0;
    double opacity = 0;
    double distance_m = 0;
};

struct ReferenceScene {
    std::vector<ReferenceLayer> layers;
    double transmittance = 1;
};

// Returns the extinction in 1/m at a place: x and y in metres from the tile's corner, z the altitude.
double reference_extinction(const CloudMedium& medium, const glm::dvec3& at);

// Returns the optical depth of all layers from a place towards the sun, by `steps` samples in each.
double reference_depth(const std::vector<SceneLayer>& layers, const SunDirection& sun,
                       const glm::dvec3& from, int steps);

// `steps` samples along the part of the ray that is in any layer.
ReferenceScene reference_scene(const std::vector<SceneLayer>& layers, const SunDirection& sun,
                               const CloudCamera& camera, const glm::dvec3& direction, int steps);

}  // namespace skybake
