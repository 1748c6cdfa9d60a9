#include "bakers/assets/occupancy/occupancy_check.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include "bakers/occupancy/cell_range.h"
#include "bakers/occupancy/occupied_cells.h"
#include "config/assets/occupancy_filter.h"
#include "tests/occupancy/volumes_in_memory.h"

namespace skybake::occupancy {
namespace {

using config::OccupancyFilter;
using test::Values;
using test::Volume;

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
