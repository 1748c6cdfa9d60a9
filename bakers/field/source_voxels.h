// The voxels of a volume that this program has not made. They stand in space as the cloud does: x
// and y lie in the ground plan, and z is up.
#pragma once

#include <array>
#include <memory>

#include "bakers/field/level.h"

namespace skybake {

struct SourceVoxels {
    std::array<int, 3> size{};
    std::array<double, 3> voxel_size_m{};  // edges of a voxel
    // One channel. A box may reach beyond the size; values there are `beyond`.
    std::shared_ptr<const VoxelSource> voxels;
    float beyond = 0;
    float largest = 0;  // no value is above it, `beyond` included
};

}  // namespace skybake
