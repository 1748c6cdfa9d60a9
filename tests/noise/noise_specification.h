// The specification of the vector kernels, which must equal it bit for bit on every instruction
// set: one voxel at a time in plain float, written to be read. The order of every sum is part of
// the specification.
//
// Voxels may have any integer coordinates; the tile repeats.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "bakers/noise/noise_plan.h"

namespace skybake::noise {

using Voxel = std::array<std::int64_t, 3>;

// Returns all output channels.
std::vector<float> noise_at(const NoisePlan& plan, const Voxel& voxel);

}  // namespace skybake::noise
