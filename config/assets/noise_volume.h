// This header declares the asset "noise_volume": the voxels of a noise.
#pragma once

#include <array>
#include <string>

#include "config/assets/asset.h"
#include "config/sections/files.h"

namespace skybake::config {

struct NoiseVolumeBake : VolumeFrames {
    std::string noise;          // NAME of a [noise.NAME]
    std::array<int, 3> size{};  // voxels along x, y, z
};

const AssetKind& asset_kind(Tag<NoiseVolumeBake>);

}  // namespace skybake::config
