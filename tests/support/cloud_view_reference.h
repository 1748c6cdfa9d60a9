// The definition of cloud_view.h along one ray, slowly and in double: what tests hold the kernel
// against. No leaps, no light that two samples share, samples in the middle of their steps.
#pragma once

#include "tests/support/cloud_marches.h"

namespace skybake {

// The same members as those of RayResults.
struct ReferenceRay {
    double sun_at_base = 0;
    double sun_at_top = 0;
    double from_sky = 0;
    double from_ground = 0;
    double transmittance = 1;
    double distance_m = 0;
};

// `steps` samples over the ray's span in the layer, and from each as many over its way to the sun.
ReferenceRay reference_ray(const CloudMedium& medium, const DiffuseShare& diffuse,
                           const MarchSettings& settings, const glm::dvec3& direction, int steps);

}  // namespace skybake
