// One voxel of a cloud at a time in plain float: what the vector kernels must equal bit for bit on
// every instruction set.
#pragma once

#include <vector>

#include "bakers/clouds/cloud_plan.h"
#include "bakers/noise/noise_specification.h"

namespace skybake::cloud {

// All channels at a voxel; x and y may lie outside of the tile, which repeats.
std::vector<float> cloud_at(const CloudPlan& plan, const noise::Voxel& voxel);

}  // namespace skybake::cloud
