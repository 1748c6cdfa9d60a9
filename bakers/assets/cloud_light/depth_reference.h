// The optical depth of a cloud's layer along a single ray, integrated plainly. The kernel
// (depth_sweep.h) is measured against it and shares nothing with it but the definition.
#pragma once

#include "bakers/assets/cloud_light/cloud_layer.h"
#include "bakers/math/vectors.h"

namespace skybake::cloud_light {

// Returns the optical depth from a place within the layer to the layer's top along a unit direction
// that rises, through the layer as it repeats.
//
// Between the planes through voxel centres the filtered value is a cubic of the distance. Without an
// edge the three-point rule of Gauss and Legendre is exact there; with one the integral is adaptive,
// to 1e-6 of its value or 1e-9.
double optical_depth_reference(const CloudLayer& layer, const glm::dvec3& place,
                               const glm::dvec3& direction);

}  // namespace skybake::cloud_light
