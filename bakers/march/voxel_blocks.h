// Blocks of voxels that divide a volume evenly.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "bakers/march/cloud_medium.h"

namespace skybake {

// A grid of blocks of at most `block` voxels. Block k of an axis has the voxels
// floor(k N / n) ... floor((k + 1) N / n) - 1.
struct VoxelBlocks {
    std::array<int, 3> voxels{};
    std::array<int, 3> size{};

    VoxelBlocks(const std::array<int, 3>& voxels_, const std::array<int, 3>& block)
        : voxels(voxels_) {
        for (std::size_t a = 0; a < 3; ++a) size[a] = (voxels[a] + block[a] - 1) / block[a];
    }
    int first(std::size_t axis, int k) const {
        return static_cast<int>(std::int64_t{k} * voxels[axis] / size[axis]);
    }
    std::size_t plane_count() const {
        return static_cast<std::size_t>(size[0]) * static_cast<std::size_t>(size[1]);
    }
};

// Returns the mean density of the voxels of a block.
double mean_density(const CloudMedium& medium, const VoxelBlocks& blocks, int i, int j, int k);

}  // namespace skybake
