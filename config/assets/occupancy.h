// This header declares the asset "occupancy": which cells of a cloud volume are empty, and the
// empty-space skip distance from them.
#pragma once

#include <string>
#include <vector>

#include "config/assets/occupancy_filter.h"
#include "config/sections/files.h"

namespace skybake::config {

enum class OccupancyRule { exact, thesis };
enum class OccupancyContent { occupied, leap, minimum, maximum };

struct OccupancyBake : AssetFiles {
    std::string of;       // NAME of a [bake.NAME] with asset = "cloud_volume"
    std::string channel;  // a channel of that volume; empty: its first
    int cell = 2;         // voxels along each edge of a cell: 1, 2, 4, 8 or 16
    OccupancyFilter filter = OccupancyFilter::trilinear;  // with which a runtime looks it up
    OccupancyRule rule = OccupancyRule::exact;
    std::vector<OccupancyContent> contents;  // the channels, in this order, without duplicates
};

}  // namespace skybake::config

namespace skybake {
using config::OccupancyBake;
}  // namespace skybake
