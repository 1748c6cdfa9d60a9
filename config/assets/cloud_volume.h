// This header declares the asset "cloud_volume", the voxels of a cloud, and computes the extent and
// the voxels of such a volume.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <string>

#include "config/sections/cloud.h"
#include "config/sections/files.h"
#include "config/text/quantity.h"

namespace skybake::config {

struct CloudVolumeBake : VolumeFrames {
    std::string cloud;               // NAME of a [clouds.NAME]
    std::array<int, 3> size{};       // voxels along x, y and height
    std::array<Length, 3> extent{};  // edges of the voxels' box; 0: the cloud's
    std::optional<double> cover;     // the share of columns with cloud; none: as coverage gives it
};

// Returns what a cloud volume spans along x, y and up: the bake's own extent or, where it has none,
// the cloud's.
inline std::array<Length, 3> volume_extent(const Cloud& cloud, const CloudVolumeBake& bake) {
    return bake.extent[0].meters > 0 ? bake.extent : cloud.extent;
}

// Returns the edges of a voxel in metres, along x, y and up.
inline std::array<double, 3> voxel_edges(const Cloud& cloud, const CloudVolumeBake& bake) {
    const std::array<Length, 3> extent = volume_extent(cloud, bake);
    std::array<double, 3> edges{};
    for (std::size_t i = 0; i < 3; ++i) edges[i] = extent[i].meters / bake.size[i];
    return edges;
}

// Returns the cloud with the extent that the bake gives it.
inline Cloud stretched(Cloud cloud, const CloudVolumeBake& bake) {
    cloud.extent = volume_extent(cloud, bake);
    return cloud;
}

// This tells how many voxels of a given edge cover an extent, and whether they are longer than it.
struct WholeVoxels {
    double count = 0;  // at least 1
    bool longer = false;
};

// Both lengths are decimal numbers that were rounded to doubles, and their quotient is rounded too.
// A quotient that differs from a whole number only by these roundings counts as that number.
inline WholeVoxels whole_voxels(Length extent, Length edge) {
    constexpr double roundings = 4;
    const double quotient = extent.meters / edge.meters;
    const double nearest = std::round(quotient);
    const double rounding = roundings * std::numeric_limits<double>::epsilon() * quotient;
    if (nearest >= 1 && std::abs(quotient - nearest) <= rounding) return {nearest, false};
    return {std::max(1.0, std::ceil(quotient)), true};
}

}  // namespace skybake::config

namespace skybake {
using config::CloudVolumeBake;
}  // namespace skybake
