#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <vector>

#include "bakers/occupancy/cell_range.h"
#include "bakers/occupancy/leap_distance.h"
#include "bakers/occupancy/marcher.h"
#include "bakers/occupancy/occupied_cells.h"
#include "tests/occupancy/volumes_in_memory.h"

namespace skybake::occupancy {
namespace {

using test::OccupancyFilter;
using test::Volume;

constexpr std::array<int, 3> kVoxels = {48, 32, 24};
constexpr std::array<double, 3> kVoxel_m = {20, 30, 10};

Volume volume_where(const std::function<bool(int, int, int)>& has_cloud) {
    Volume volume = test::volume_of({kVoxels, 4});
    for (int z = 0; z < kVoxels[2]; ++z) {
        for (int y = 0; y < kVoxels[1]; ++y) {
            for (int x = 0; x < kVoxels[0]; ++x) volume.at(x, y, z) = has_cloud(x, y, z) ? 1 : 0;
        }
    }
    return volume;
}

SkippingGain gain_of(const Volume& volume, int threads = 1) {
    VoxelBits bits(kVoxels);
    for (int z = 0; z < kVoxels[2]; ++z) {
        for (int y = 0; y < kVoxels[1]; ++y) {
            bits.set_row(y, z, &volume.voxels[index_of(kVoxels, 0, y, z)], 0);
        }
    }
    const std::vector<std::uint8_t> leaps = leap_distance(occupied_cells(
        cell_ranges(volume.voxels.data(), volume.grid, OccupancyFilter::trilinear), 0));
    const LeapCells cells{volume.grid, leaps};
    return skipping_gain(bits, kVoxel_m, OccupancyFilter::trilinear, cells, {.threads = threads});
}

// Cosines from 1 to 1/2, all as often, have the mean 2 log(2) of their inverse.
TEST(SkippingGain, IsBesideAMarchThatBeginsAndEndsWithTheLayer) {
    const SkippingGain empty = gain_of(volume_where([](int, int, int) { return false; }));
    EXPECT_NEAR(empty.without, kVoxels[2] * 2 * std::log(2.0), 0.05);
    EXPECT_NEAR(empty.with, 1, 1e-9);
}

// A ray asks once, and not again within cloud.
TEST(SkippingGain, IsALossWhereAllIsCloud) {
    const SkippingGain full = gain_of(volume_where([](int, int, int) { return true; }));
    EXPECT_NEAR(full.with, full.without + 1, 1e-9);
}

// A slab at the top takes one leap and a look at each sample in its cells. From one at the base leaps
// begin anew, short ones first.
TEST(SkippingGain, IsOfRaysFromBelow) {
    const SkippingGain low = gain_of(volume_where([](int, int, int z) { return z < 3; }));
    const SkippingGain high = gain_of(volume_where([](int, int, int z) { return z > 20; }), 2);
    EXPECT_NEAR(high.with, 2 + high.without * 4 / kVoxels[2], 0.5);
    EXPECT_GT(low.with, high.with + 2);
}

}  // namespace
}  // namespace skybake::occupancy
