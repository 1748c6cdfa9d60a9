// This header declares the asset "cloud_distance": how far it is from places in a cloud volume to
// the cloud, so that a ray may be traced in spheres.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "config/sections/files.h"
#include "config/text/quantity.h"

namespace skybake::config {

enum class DistanceContent { distance, profile, detail_type, density_scale };

struct CloudDistanceBake : AssetFiles {
    std::string of;                 // NAME of a [bake.NAME] with asset = "cloud_volume"
    std::string channel;            // a channel of that volume; empty: its first
    int cell = 4;                   // voxels along each edge of a texel: 1, 2, 4, 8 or 16
    std::array<Length, 2> range{};  // distances beyond it are stored as its ends; 0 lies within
    Length core;                    // depth at which the profile is 1; 0: the volume's greatest
    std::vector<DistanceContent> contents;  // the channels; the first one is the distance
};

}  // namespace skybake::config
