// Leap distances and the pyramids that they stand on.
#include "bakers/occupancy/leap_distance.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "bakers/occupancy/occupied_cells.h"
#include "config/assets/occupancy_filter.h"
#include "tests/noise/every_target.h"
#include "tests/occupancy/volumes_in_memory.h"
#include "tests/support/volumes.h"

namespace skybake::occupancy {
namespace {

int wrapped_distance(int a, int b, int size) {
    const int direct = std::abs(a - b);
    return std::min(direct, size - direct);
}

// Compares each cell with every occupied one.
std::vector<std::uint8_t> leap_distance_reference(const OccupiedCells& cells) {
    const std::array<int, 3>& size = cells.size;
    std::vector<std::array<int, 3>> occupied;
    testing::for_each_voxel(size, [&](int x, int y, int z) {
        if (cells.occupied[index_of(size, x, y, z)] != 0) occupied.push_back({x, y, z});
    });
    std::vector<std::uint8_t> distances;
    testing::for_each_voxel(size, [&](int x, int y, int z) {
        int nearest = 255;
        for (const auto& [other_x, other_y, other_z] : occupied) {
            nearest = std::min(
                nearest, std::max({wrapped_distance(x, other_x, size[0]),
                                   wrapped_distance(y, other_y, size[1]), std::abs(z - other_z)}));
        }
        distances.push_back(static_cast<std::uint8_t>(nearest));
    });
    return distances;
}

OccupiedCells cells_of(const std::array<int, 3>& size, const std::vector<std::size_t>& occupied) {
    OccupiedCells cells{size, std::vector<std::uint8_t>(count_of(size))};
    for (const std::size_t cell : occupied) cells.occupied[cell % cells.occupied.size()] = 1;
    return cells;
}

// Few cells are occupied as a rule, so that distances are long.
OccupiedCells any_cells() {
    const int longest = *rc::gen::element(4, 13, 24);
    std::array<int, 3> size{};
    for (int& count : size) count = *rc::gen::inRange(1, longest + 1);
    if (*rc::gen::inRange(0, 4) == 0) {
        size = {*rc::gen::inRange(60, 300), *rc::gen::inRange(1, 6), *rc::gen::inRange(1, 6)};
        std::rotate(size.begin(), size.begin() + *rc::gen::inRange(0, 3), size.end());
    }
    const int occupied = *rc::gen::element(0, 1, 2, 3, 8, 40);
    std::vector<std::size_t> places;
    for (int i = 0; i < occupied; ++i) places.push_back(*rc::gen::arbitrary<std::uint32_t>());
    return cells_of(size, places);
}

TEST(LeapDistance, IsTheDistanceToTheNearestOnEveryTarget) {
    EXPECT_TRUE(rc::check([] {
        const OccupiedCells cells = any_cells();
        const std::vector<std::uint8_t> wanted = leap_distance_reference(cells);
        bool same = true;
        test::on_every_target([&](const char*) { same = same && leap_distance(cells) == wanted; });
        RC_ASSERT(same);
    }));
}

TEST(LeapDistance, WrapsAroundAlongTheGroundOnly) {
    const std::array<int, 3> size = {10, 12, 8};
    const auto distances = leap_distance(cells_of(size, {0}));
    EXPECT_EQ(distances[index_of(size, 0, 0, 0)], 0);
    EXPECT_EQ(distances[index_of(size, 9, 0, 0)], 1);
    EXPECT_EQ(distances[index_of(size, 0, 11, 0)], 1);
    EXPECT_EQ(distances[index_of(size, 9, 11, 0)], 1);
    EXPECT_EQ(distances[index_of(size, 5, 0, 0)], 5);
    EXPECT_EQ(distances[index_of(size, 0, 6, 0)], 6);
    EXPECT_EQ(distances[index_of(size, 0, 0, 7)], 7);
    EXPECT_EQ(distances[index_of(size, 9, 11, 7)], 7);
}

TEST(LeapDistance, Stops255CellsAway) {
    for (const std::array<int, 3>& size :
         {std::array<int, 3>{700, 1, 1}, {1, 700, 1}, {1, 1, 700}, {3, 515, 2}}) {
        const OccupiedCells cells = cells_of(size, {0});
        const auto distances = leap_distance(cells);
        EXPECT_EQ(distances, leap_distance_reference(cells));
        EXPECT_EQ(*std::max_element(distances.begin(), distances.end()), 255);
    }
    const auto none = leap_distance(cells_of({3, 2, 4}, {}));
    EXPECT_EQ(none, std::vector<std::uint8_t>(24, 255));
}

TEST(Pyramid, BoundsWhatIsBelow) {
    EXPECT_TRUE(rc::check([] {
        const test::Volume volume = test::any_volume(30, test::Values::signs);
        CellRanges ranges =
            cell_ranges(volume.voxels.data(), volume.grid, config::OccupancyFilter::trilinear);
        OccupiedCells cells = occupied_cells(ranges, 0.5F);
        int levels = 0;
        while (count_of(ranges.size) > 1) {
            const CellRanges above = next_level(ranges);
            const OccupiedCells cells_above = next_level(cells);
            CellRanges tight{next_level_size(ranges.size), {}, {}};
            for (std::size_t a = 0; a < 3; ++a) {
                RC_ASSERT(above.size[a] == (ranges.size[a] + 1) / 2);
            }
            tight.minimum.assign(count_of(tight.size), 2.0F);
            tight.maximum.assign(count_of(tight.size), -2.0F);
            testing::for_each_voxel(ranges.size, [&](int x, int y, int z) {
                const std::size_t fine = index_of(ranges.size, x, y, z);
                const std::size_t coarse = index_of(above.size, x / 2, y / 2, z / 2);
                float& least = tight.minimum[coarse];
                float& most = tight.maximum[coarse];
                least = std::min(least, ranges.minimum[fine]);
                most = std::max(most, ranges.maximum[fine]);
            });
            RC_ASSERT(above.minimum == tight.minimum);
            RC_ASSERT(above.maximum == tight.maximum);
            // The threshold of a union is passed where one of its parts passes it.
            RC_ASSERT(cells_above.size == above.size);
            RC_ASSERT(cells_above.occupied == occupied_cells(above, 0.5F).occupied);
            ranges = above;
            cells = cells_above;
            ++levels;
        }
        const int longest = *std::max_element(volume.grid.voxels.begin(), volume.grid.voxels.end());
        RC_ASSERT(levels == static_cast<int>(std::ceil(std::log2(
                                std::ceil(static_cast<double>(longest) / volume.grid.cell)))));
    }));
}

}  // namespace
}  // namespace skybake::occupancy
