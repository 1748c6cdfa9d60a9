// This header declares the asset "blue_noise": a mask of spatiotemporal blue noise.
#pragma once

#include <array>
#include <cstdint>

#include "config/sections/files.h"

namespace skybake::config {

struct BlueNoiseBake : AssetFiles {
    std::array<int, 2> size{};  // pixels along x and y
    int frames = 0;
    std::uint64_t seed = 0;
    double spatial_sigma = 0;   // of the energy within a frame, in pixels
    double temporal_sigma = 0;  // of the energy of one pixel over time, in frames

    std::array<int, 3> voxels() const { return {size[0], size[1], frames}; }
};

}  // namespace skybake::config
