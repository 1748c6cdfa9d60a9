// This header declares the asset "noise_volume": the voxels of a noise.
#pragma once

#include <array>
#include <string>

#include "config/sections/files.h"

namespace skybake::config {

struct NoiseVolumeBake : VolumeFrames {
    std::string noise;          // NAME of a [noise.NAME]
    std::array<int, 3> size{};  // voxels along x, y, z
};

}  // namespace skybake::config
