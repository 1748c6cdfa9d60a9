// Numbers of the voxels in a box: x fastest, then y, then z.
#pragma once

#include <array>
#include <cstdint>

#include "bakers/field/level.h"

namespace skybake {

// Returns the number of a voxel.
inline std::int64_t index_in(const VoxelBox& box, const std::array<int, 3>& voxel) {
    const auto from = [&](std::size_t axis) {
        return std::int64_t{voxel[axis]} - box.origin[axis];
    };
    return (from(2) * box.size[1] + from(1)) * box.size[0] + from(0);
}

// Returns the voxel of a number.
inline std::array<int, 3> voxel_at(const VoxelBox& box, std::int64_t index) {
    const std::int64_t row = index / box.size[0];
    return {box.origin[0] + static_cast<int>(index % box.size[0]),
            box.origin[1] + static_cast<int>(row % box.size[1]),
            box.origin[2] + static_cast<int>(row / box.size[1])};
}

}  // namespace skybake
