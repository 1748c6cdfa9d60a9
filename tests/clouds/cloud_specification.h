// The specification of the vector kernels, which must equal it bit for bit on every instruction
// set: one voxel of a cloud at a time in plain float.
#pragma once

#include <vector>

#include "bakers/clouds/cloud_plan.h"
#include "tests/noise/noise_specification.h"

namespace skybake::cloud {

// Returns all channels at a voxel. x and y may lie outside the tile, which repeats.
std::vector<float> cloud_at(const CloudPlan& plan, const noise::Voxel& voxel);

}  // namespace skybake::cloud
