// What an octave becomes on a grid of voxels, by integer arithmetic.
#pragma once

#include <array>

#include "config/sections/noise.h"

namespace skybake::config {

inline constexpr int fewest_voxels_per_cell = 4;

// Whether a cell has fewer voxels than it takes to show it, on an axis of more than one voxel.
bool is_coarse(const std::array<int, 3>& frequency, const std::array<int, 3>& size);

// Whether every voxel lies on a lattice point, where gradient noise is 0 by definition. Voxel i of
// N lies at (i + 1/2) f / N cells, or at i f / N on axes that are sampled at corners.
bool is_zero_everywhere(const std::array<int, 3>& frequency, const std::array<int, 3>& size,
                        NoiseSampling sampling);

}  // namespace skybake::config
