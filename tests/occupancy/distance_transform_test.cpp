// The transform against every cell of small volumes, and what its passes may not depend on.
#include "bakers/occupancy/distance_transform.h"

#include <gtest/gtest.h>
#include <hwy/highway.h>
#include <rapidcheck.h>

#include <limits>
#include <vector>

#include "bakers/occupancy/cloud_bits.h"
#include "tests/occupancy/distance_reference.h"
#include "tests/occupancy/distance_trial.h"
#include "tests/support/every_target.h"

namespace skybake::occupancy {
namespace {

using test::bits_of;
using test::Edges;
using test::Volume;

std::vector<float> squares_of(const VoxelBits& bits, const DistanceGrid& grid, CellKind kind,
                              int threads = 1) {
    const std::array<int, 3> size = grid.grid.size();
    std::vector<float> squares(count_of(size), -1);
    ScratchFloats scratch;
    distance_squares(bits, grid, kind, {.threads = threads}, scratch,
                     [&](int x, int y, int z, int count, const float* found) {
                         std::copy_n(found, count, &squares[index_of(size, x, y, z)]);
                     });
    return squares;
}

std::array<double, 3> centre_of(const CellGrid& grid, int x, int y, int z) {
    return {(x + 0.5) * grid.cell, (y + 0.5) * grid.cell, (z + 0.5) * grid.cell};
}

// A volume whose texels tile it, mostly empty, mostly full, or between.
Volume any_tiled_volume(int largest) {
    CellGrid grid;
    grid.cell = *rc::gen::element(1, 1, 2, 4, 8);
    for (std::size_t a = 0; a < 2; ++a) {
        grid.voxels[a] = grid.cell * *rc::gen::inRange(1, largest / grid.cell + 1);
    }
    grid.voxels[2] = *rc::gen::inRange(1, largest + 1);
    Volume volume = test::volume_of(grid);
    const auto seed = *rc::gen::arbitrary<std::uint32_t>();
    const auto rarity = *rc::gen::element(2U, 8U, 200U, 3000U);
    const bool holes = *rc::gen::arbitrary<bool>();
    for (std::size_t i = 0; i < volume.voxels.size(); ++i) {
        const bool rare = test::mixed(seed + static_cast<std::uint32_t>(i)) % rarity == 0;
        volume.voxels[i] = rare != holes ? 1.0F : 0.0F;
    }
    return volume;
}

// Edges whose halves' squares, and sums of them, floats hold exactly: the transform rounds nothing.
Edges any_whole_edges() {
    return {*rc::gen::inRange(1, 16) * 2.0, *rc::gen::inRange(1, 16) * 2.0,
            *rc::gen::inRange(1, 16) * 2.0};
}

// Compares some squares with the least over all cells, to a share of them.
void check_squares(const Volume& volume, const Edges& voxel_m, float share) {
    const VoxelBits bits = bits_of(volume, 0.5F);
    const std::array<int, 3> size = volume.grid.size();
    for (const CellKind kind : {CellKind::touched, CellKind::holed}) {
        const std::vector<float> found = squares_of(bits, {volume.grid, voxel_m}, kind);
        for (int i = 0; i < 12; ++i) {
            const int x = *rc::gen::inRange(0, size[0]);
            const int y = *rc::gen::inRange(0, size[1]);
            const int z = *rc::gen::inRange(0, size[2]);
            const float wanted = test::least_square(
                volume, voxel_m, centre_of(volume.grid, x, y, z), 0.5F, kind == CellKind::touched);
            const float square = found[index_of(size, x, y, z)];
            RC_ASSERT(square == wanted ||
                      std::fabs(square - wanted) <= share * std::min(square, wanted));
        }
    }
}

TEST(DistanceTransform, IsTheLeastOverAllCells) {
    EXPECT_TRUE(rc::check([] {
        check_squares(any_tiled_volume(*rc::gen::element(6, 12, 24)), any_whole_edges(), 0);
    }));
}

// Where squares are rounded, the best cell of a point may be taken from its neighbours' best ones that
// are as good but for roundings.
TEST(DistanceTransform, IsOffByRoundingsForAnyEdges) {
    EXPECT_TRUE(rc::check([] {
        const auto edge = [] { return 1e-3 * *rc::gen::inRange(100, 100000); };
        check_squares(any_tiled_volume(20), {edge(), edge(), edge()}, 0x1p-20F);
    }));
}

// Rows of many words and columns of many groups, far from the only voxel: distances wrap at half the
// tile.
TEST(DistanceTransform, MeasuresRoundTheTile) {
    Volume volume = test::volume_of({{200, 150, 3}, 1});
    volume.at(199, 0, 1) = 1;
    const DistanceGrid grid{volume.grid, {2, 4, 6}};
    const std::vector<float> found = squares_of(bits_of(volume, 0), grid, CellKind::touched);
    for (int y = 0; y < 150; y += 37) {
        for (int x = 0; x < 200; x += 19) {
            ASSERT_EQ(
                found[index_of(volume.grid.voxels, x, y, 2)],
                test::least_square(volume, grid.voxel_m, centre_of(volume.grid, x, y, 2), 0, true))
                << x << " " << y;
        }
    }
}

TEST(DistanceTransform, OfNothingAndOfAllIsStated) {
    for (const int cell : {1, 4}) {
        const DistanceGrid grid{{{8, 4, 10}, cell}, {2, 2, 2}};
        const VoxelBits empty(grid.grid.voxels);
        for (const float square : squares_of(empty, grid, CellKind::touched)) {
            EXPECT_EQ(square, std::numeric_limits<float>::infinity());
        }
        for (const float square : squares_of(empty, grid, CellKind::holed)) EXPECT_EQ(square, 0);
        const VoxelBits full = bits_of(test::volume_of(grid.grid, 1), 0);
        for (const float square : squares_of(full, grid, CellKind::touched)) EXPECT_EQ(square, 0);
        // To the nearer of base and top; the middle of the last texel may lie above the top.
        const std::array<int, 3> size = grid.grid.size();
        const std::vector<float> depths = squares_of(full, grid, CellKind::holed);
        for (int z = 0; z < size[2]; ++z) {
            const double at = (z + 0.5) * cell;
            const double depth = 2 * std::max(0.0, std::min(at, 10 - at));
            EXPECT_EQ(depths[index_of(size, 1, 0, z)], static_cast<float>(depth * depth));
        }
    }
}

TEST(DistanceTransform, DoesNotDependOnThreadsOrVectors) {
    Volume volume = test::volume_of({{72, 40, 33}, 2});
    for (std::size_t i = 0; i < volume.voxels.size(); ++i) {
        volume.voxels[i] = test::mixed(static_cast<std::uint32_t>(i)) % 900 == 0 ? 1.0F : 0.0F;
    }
    const DistanceGrid grid{volume.grid, {1.1, 0.7, 1.3}};
    const VoxelBits bits = bits_of(volume, 0);
    const std::vector<float> wanted = squares_of(bits, grid, CellKind::touched);
    EXPECT_EQ(squares_of(bits, grid, CellKind::touched, 3), wanted);
    test::on_every_target([&](const char* target) {
        EXPECT_EQ(squares_of(bits, grid, CellKind::touched), wanted) << target;
    });
}

// The search that judges the distances of files, at any place.
TEST(NearestVoxel, IsTheLeastOverAllCells) {
    EXPECT_TRUE(rc::check([] {
        const Volume volume = any_tiled_volume(*rc::gen::element(5, 14, 40));
        const Edges voxel_m = any_whole_edges();
        const VoxelBits bits = bits_of(volume, 0.5F);
        const NearestVoxel nearest(bits, voxel_m);
        for (int i = 0; i < 8; ++i) {
            std::array<double, 3> place{};
            for (std::size_t a = 0; a < 3; ++a) {
                place[a] = *rc::gen::inRange(0, 8 * volume.grid.voxels[a] + 1) / 8.0;
            }
            for (const bool above : {true, false}) {
                const double way = above ? nearest.to_cloud(place) : nearest.to_hole(place);
                const float wanted = test::least_square(volume, voxel_m, place, 0.5F, above);
                RC_ASSERT(static_cast<float>(way * way) == wanted ||
                          std::fabs(way * way - double{wanted}) <= 1e-6 * way * way);
            }
        }
    }));
}

}  // namespace
}  // namespace skybake::occupancy
