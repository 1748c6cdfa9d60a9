#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>

#include "bakers/assets/occupancy/occupancy_check.h"
#include "bakers/occupancy/cell_range.h"
#include "bakers/occupancy/occupied_cells.h"
#include "config/assets/occupancy_filter.h"
#include "tests/occupancy/exact_range.h"
#include "tests/occupancy/volumes_in_memory.h"
#include "tests/support/volumes.h"

namespace skybake::occupancy {

namespace {

using config::OccupancyFilter;
using test::Values;
using test::Volume;

// Both ways: an occupied cell has a point whose filtered value is above the threshold, an empty one
// has none; for thresholds of all kinds, those that voxels and their means hold among them.
TEST(OccupiedCells, AreThoseThatLookupsCanFind) {
    EXPECT_TRUE(rc::check([] {
        const Values values = test::any_values();
        const Volume volume = test::any_volume(20, values);
        const int unit = test::unit_of(values);
        const CellRanges ranges =
            cell_ranges(volume.voxels.data(), volume.grid, OccupancyFilter::trilinear);
        const auto any_voxel = [&] {
            return volume.voxels[*rc::gen::inRange<std::size_t>(0, volume.voxels.size())];
        };
        const float mean = static_cast<float>((double{any_voxel()} + double{any_voxel()}) / 2);
        const float of_cell =
            ranges.maximum[*rc::gen::inRange<std::size_t>(0, ranges.maximum.size())];
        for (const float threshold : {0.0F, 1.0F, any_voxel(), mean, of_cell}) {
            if (values == Values::denormals && threshold == 1.0F) continue;  // beyond its units
            const OccupiedCells cells = occupied_cells(ranges, threshold);
            std::size_t index = 0;
            testing::for_each_voxel(cells.size, [&](int i, int j, int k) {
                const test::ExactRange range = test::exact_range(volume, {i, j, k}, unit);
                const bool above = range.most > 8 * test::in_units(threshold, unit);
                RC_ASSERT((cells.occupied[index++] != 0) == above);
            });
        }
    }));
}

OccupiedCells thesis_by_hand(const Volume& volume, float threshold) {
    OccupiedCells cells{volume.grid.size(), {}};
    cells.occupied.resize(count_of(cells.size));
    std::vector<int> above(cells.occupied.size());
    std::vector<int> voxels(cells.occupied.size());
    const auto cell_of = [&](int x, int y, int z) {
        const int cell = volume.grid.cell;
        return index_of(cells.size, x / cell, y / cell, z / cell);
    };
    testing::for_each_voxel(volume.grid.voxels, [&](int x, int y, int z) {
        ++voxels[cell_of(x, y, z)];
        above[cell_of(x, y, z)] += volume.at(x, y, z) > threshold ? 1 : 0;
    });
    testing::for_each_voxel(cells.size, [&](int x, int y, int z) {
        const std::size_t at = index_of(cells.size, x, y, z);
        if (above[at] < voxels[at] / 8.0) return;
        testing::for_each_voxel({3, 3, 3}, [&](int i, int j, int k) {
            const std::array<int, 3> other = {x + i - 1, y + j - 1, z + k - 1};
            for (std::size_t a = 0; a < 3; ++a) {
                if (other[a] < 0 || other[a] >= cells.size[a]) return;
            }
            cells.occupied[index_of(cells.size, other[0], other[1], other[2])] = 1;
        });
    });
    return cells;
}

TEST(OccupiedCells, AsInThesisAreEighthsAndARing) {
    EXPECT_TRUE(rc::check([] {
        const Volume volume =
            test::any_volume(40, *rc::gen::element(Values::uniform, Values::sparse, Values::steps));
        const float threshold = *rc::gen::element(0.0F, 0.5F, 0.75F, 0.875F, 0.9F);
        const OccupiedCells wanted = thesis_by_hand(volume, threshold);
        const OccupiedCells found = test::cells_of_thesis(volume, threshold);
        RC_ASSERT(found.size == wanted.size);
        RC_ASSERT(found.occupied == wanted.occupied);
    }));
}

TEST(OccupiedCells, AsInThesisCountEightOf64) {
    Volume volume = test::volume_of({{20, 20, 20}, 4});
    for (int i = 0; i < 7; ++i) volume.at(8 + i % 4, 8 + i / 4, 9) = 1;
    const auto count = [&] {
        const OccupiedCells cells = test::cells_of_thesis(volume, 0);
        return std::count(cells.occupied.begin(), cells.occupied.end(), 1);
    };
    EXPECT_EQ(count(), 0);
    volume.at(11, 11, 11) = 0x1p-149F;
    EXPECT_EQ(count(), 27);
}

// The voxels as the second of two channels, in pieces of `piece` voxels.
OccupancyCheckResult check(const Volume& volume, const std::vector<std::uint8_t>& occupied,
                           OccupancyFilter filter, float threshold, int points,
                           std::int64_t piece) {
    OccupancyCheck check(volume.grid, occupied, filter, threshold, 1, 2, points);
    std::vector<float> values;
    const auto count = static_cast<std::int64_t>(volume.voxels.size());
    for (std::int64_t first = 0; first < count; first += piece) {
        const std::int64_t end = std::min(count, first + piece);
        values.clear();
        for (std::int64_t i = first; i < end; ++i) {
            values.push_back(1000);
            values.push_back(volume.voxels[static_cast<std::size_t>(i)]);
        }
        check.add(first, end - first, values.data());
    }
    return check.result();
}

std::vector<std::uint8_t> exact_cells(const Volume& volume, OccupancyFilter filter,
                                      float threshold) {
    return occupied_cells(cell_ranges(volume.voxels.data(), volume.grid, filter), threshold)
        .occupied;
}

TEST(OccupancyCheck, FindsNothingInExactGrids) {
    EXPECT_TRUE(rc::check([] {
        const Volume volume =
            test::any_volume(24, *rc::gen::element(Values::uniform, Values::sparse, Values::steps,
                                                   Values::denormals, Values::constant));
        const float threshold = *rc::gen::element(0.0F, 0.5F, 0.7F, 0.96F);
        const auto piece = *rc::gen::inRange<std::int64_t>(1, 3000);
        for (const OccupancyFilter filter : test::kFilters) {
            const OccupancyCheckResult found = check(volume, exact_cells(volume, filter, threshold),
                                                     filter, threshold, 2000, piece);
            RC_ASSERT(found.points == 2000);
            RC_ASSERT(found.lost == 0);
        }
    }));
}

TEST(OccupancyCheck, FindsACellThatIsMissing) {
    Volume volume = test::volume_of({{30, 22, 18}, 4});
    volume.at(13, 9, 10) = 2;
    volume.at(29, 21, 17) = 3;
    for (const OccupancyFilter filter : test::kFilters) {
        std::vector<std::uint8_t> occupied = exact_cells(volume, filter, 0);
        EXPECT_EQ(check(volume, occupied, filter, 0, 100000, 1000).lost, 0);
        occupied[index_of(volume.grid.size(), 3, 2, 2)] = 0;
        const OccupancyCheckResult found = check(volume, occupied, filter, 0, 100000, 777);
        EXPECT_EQ(found.points, 100000);
        EXPECT_GT(found.lost, 0);
        EXPECT_EQ(found.cell, (std::array<int, 3>{3, 2, 2}));
        EXPECT_GT(found.worst_value, filter == OccupancyFilter::tricubic ? 0.4F : 1);
        EXPECT_LE(found.worst_value, 2);
        const std::array<double, 3> voxel = {13.5, 9.5, 10.5};
        for (std::size_t a = 0; a < 3; ++a) EXPECT_NEAR(found.place[a], voxel[a], 0.5);
        EXPECT_EQ(found.worst_value, static_cast<float>(test::lookup(volume, filter, found.place)));
    }
}

// The grid without the cells that only the filter reaches, across the seam as well.
TEST(OccupancyCheck, FindsWhatOnlyTheFilterReaches) {
    Volume volume = test::volume_of({{16, 16, 16}, 4});
    volume.at(0, 15, 4) = 1;
    const auto nearest = exact_cells(volume, OccupancyFilter::nearest, 0);
    for (const OccupancyFilter filter : {OccupancyFilter::trilinear, OccupancyFilter::tricubic}) {
        const OccupancyCheckResult found = check(volume, nearest, filter, 0, 100000, 4096);
        EXPECT_GT(found.lost, 0);
        EXPECT_NE(found.cell, (std::array<int, 3>{0, 3, 1}));
        EXPECT_EQ(check(volume, nearest, filter, 0.97F, 100000, 4096).lost, 0);
    }
}

}  // namespace

}  // namespace skybake::occupancy
