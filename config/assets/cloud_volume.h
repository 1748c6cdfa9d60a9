// asset = "cloud_volume". The voxels of a cloud.
#pragma once

#include <array>
#include <string>

#include "config/assets/asset.h"
#include "config/sections/files.h"
#include "config/text/quantity.h"

namespace skybake::config {

struct CloudVolumeBake : AssetFiles {
    std::string cloud;               // NAME of a [clouds.NAME]
    std::array<int, 3> size{};       // voxels along x, y and height
    std::array<Length, 3> extent{};  // that they span, x, y, z; 0: the cloud's
};

const AssetKind& asset_kind(Tag<CloudVolumeBake>);

}  // namespace skybake::config
