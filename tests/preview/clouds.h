// Clouds in memory for tests of their pictures.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <vector>

#include "bakers/field/image.h"
#include "bakers/march/cloud_medium.h"
#include "tests/occupancy/volumes_in_memory.h"
#include "tests/support/comparisons.h"
#include "tests/support/volumes.h"

namespace skybake::test {

// A volume of an extinction of 10 per kilometre at density 1, on the ground or above it.
inline config::Cloud cloud_of(const std::array<double, 3>& extent_m, double base_m = 0) {
    config::Cloud cloud;
    cloud.name = "c";
    for (std::size_t a = 0; a < 3; ++a) cloud.extent[a].meters = extent_m[a];
    cloud.base_altitude.meters = base_m;
    cloud.extinction_scale.per_meter = 0.01;
    return cloud;
}

// The medium of such a volume.
inline CloudMedium medium_of(const std::array<double, 3>& extent_m, double base_m,
                             const std::array<int, 3>& size, const std::vector<float>& voxels,
                             double extinction_per_m = 0.01, int cell = 2, bool repeats = true) {
    config::Cloud cloud = cloud_of(extent_m, base_m);
    cloud.extinction_scale.per_meter = extinction_per_m;
    CloudMedium medium = cloud_medium(cloud, voxels.data(), size, 1, 1, repeats);
    medium.leaps = leaps_of_voxels(medium, cell, 1);
    return medium;
}

// In [0, 1): `filled` of them, in clumps, are not 0.
inline std::vector<float> clumped_voxels(const std::array<int, 3>& size, std::uint32_t seed,
                                         double filled) {
    std::vector<float> voxels;
    testing::for_each_voxel(size, [&](int x, int y, int z) {
        const auto clump = static_cast<std::uint32_t>(x / 3 + 64 * (y / 3) + 4096 * (z / 3));
        const auto voxel = static_cast<std::uint32_t>(x + 1024 * y + 1048576 * z);
        const bool is_filled = double{share_of(mixed(clump + seed))} < filled;
        voxels.push_back(is_filled ? share_of(mixed(voxel ^ seed)) : 0.0F);
    });
    return voxels;
}

inline double greatest_difference(const Image2<float>& a, const Image2<float>& b) {
    return largest_difference(a.texels, b.texels);
}

inline bool same_bits(const Image2<float>& a, const Image2<float>& b) {
    return same_bits(a.texels, b.texels);
}

}  // namespace skybake::test
