// Planes of a volume in memory.
#pragma once

#include <array>
#include <vector>

#include "bakers/field/image.h"

namespace skybake {

// A volume's voxels: x fastest, then y, then z, channels interleaved.
struct VoxelView {
    std::array<int, 3> size{};
    int channels = 0;
    const std::vector<float>* voxels = nullptr;
};

// One channel of the plane where `axis` (0 x, 1 y, 2 z) has the index `at`. Of x the picture is y
// across and z up, of y it is x across and z up, of z it is x across and y up; row 0 is the lowest
// index.
Image2<float> slice(const VoxelView& volume, int channel, int axis, int at);

// Two by two copies side by side, as a repeating sampler shows them.
Image2<float> tiled_twice(const Image2<float>& tile);

}  // namespace skybake
