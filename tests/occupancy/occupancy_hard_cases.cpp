// Volumes in which an occupancy grid may lose something.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "bakers/math/quadrature.h"
#include "bakers/occupancy/cell_range.h"
#include "bakers/occupancy/leap_distance.h"
#include "bakers/occupancy/occupied_cells.h"
#include "config/assets/occupancy_filter.h"
#include "tests/occupancy/exact_range.h"
#include "tests/support/hard_case.h"
#include "tests/support/loops.h"

namespace skybake::occupancy {
namespace {

using config::OccupancyFilter;
using test::hold;
using test::Volume;

CellRanges ranges_of(const Volume& volume, OccupancyFilter filter = OccupancyFilter::trilinear) {
    return cell_ranges(volume.voxels.data(), volume.grid, filter);
}

std::int64_t count(const OccupiedCells& cells) {
    return std::count(cells.occupied.begin(), cells.occupied.end(), 1);
}

OccupiedCells cells_of(const Volume& volume, float threshold = 0,
                       OccupancyFilter filter = OccupancyFilter::trilinear) {
    return occupied_cells(ranges_of(volume, filter), threshold);
}

// Cells that the integer referee has otherwise.
double unlike_referee(const Volume& volume, float threshold, int unit = 84) {
    const OccupiedCells cells = cells_of(volume, threshold);
    std::int64_t unlike = 0;
    std::size_t index = 0;
    testing::for_each_voxel(cells.size, [&](int i, int j, int k) {
        const bool above =
            test::exact_range(volume, {i, j, k}, unit).most > 8 * test::in_units(threshold, unit);
        unlike += (cells.occupied[index++] != 0) == above ? 0 : 1;
    });
    return static_cast<double>(unlike);
}

// Returns the share of the lookups above the threshold that are in empty cells.
double share_lost(const Volume& volume, const OccupiedCells& cells, float threshold, int points) {
    std::int64_t above = 0;
    std::int64_t lost = 0;
    for (int n = 0; n < points; ++n) {
        std::array<double, 3> place = low_discrepancy_point(n);
        std::array<int, 3> cell{};
        for (std::size_t a = 0; a < 3; ++a) {
            place[a] *= volume.grid.voxels[a];
            cell[a] = static_cast<int>(place[a]) / volume.grid.cell;
        }
        if (!(test::lookup(volume, OccupancyFilter::trilinear, place) > threshold)) continue;
        ++above;
        lost += cells.occupied[index_of(cells.size, cell[0], cell[1], cell[2])] != 0 ? 0 : 1;
    }
    EXPECT_GT(above, 0);
    return static_cast<double>(lost) / static_cast<double>(above);
}

TEST(OccupancyHardCase, OccupancyEmptyAndFull) {
    const CellGrid grid{{32, 24, 20}, 4};
    const auto all = static_cast<double>(count_of(grid.size()));
    hold("occupancy of nothing", "0, occupied cells",
         static_cast<double>(count(cells_of(test::volume_of(grid)))), 0);
    const auto leaps = leap_distance(cells_of(test::volume_of(grid)));
    hold("occupancy of nothing", "leap distance 255, cells unlike",
         all - static_cast<double>(std::count(leaps.begin(), leaps.end(), 255)), 0);
    for (const OccupancyFilter filter : test::kFilters) {
        const Volume full = test::volume_of(grid, 0.7F);
        hold("occupancy of a full volume", "all cells, empty ones",
             all - static_cast<double>(count(cells_of(full, 0, filter))), 0);
        hold("occupancy of a full volume, threshold its value", "0, occupied cells",
             static_cast<double>(count(cells_of(full, 0.7F, filter))), 0);
    }
}

// A voxel's values reach half a voxel beyond it: into the cells beside it if it lies at a face.
TEST(OccupancyHardCase, OccupancySingleVoxel) {
    const auto row = [](const char* where, const std::array<int, 3>& voxel, double wanted) {
        Volume volume = test::volume_of({{32, 32, 32}, 4});
        volume.at(voxel[0], voxel[1], voxel[2]) = std::numeric_limits<float>::denorm_min();
        hold(fmt::format("occupancy of a voxel {}", where), "number of cells, difference",
             std::fabs(static_cast<double>(count(cells_of(volume))) - wanted), 0);
        hold(fmt::format("occupancy of a voxel {}", where), "integers, cells unlike",
             unlike_referee(volume, 0, 149), 0);
    };
    row("inside a cell", {13, 14, 17}, 1);
    row("at a face", {16, 14, 17}, 2);
    row("at an edge", {16, 19, 17}, 4);
    row("at a corner", {16, 19, 12}, 8);
    row("at the corner of the tile, on the ground", {0, 31, 0}, 4);
    row("at the corner of the tile, on top", {31, 0, 31}, 4);
}

// Wisps a voxel wide, here and there: seldom are there seven more in the block.
TEST(OccupancyHardCase, OccupancyOneVoxelWisps) {
    constexpr int kPoints = 1000000;
    for (const std::uint32_t one_in : {1000U, 22U}) {
        Volume volume = test::volume_of({{128, 128, 128}, 4});
        for (std::size_t i = 0; i < volume.voxels.size(); ++i) {
            if (test::mixed(static_cast<std::uint32_t>(i)) % one_in == 0) volume.voxels[i] = 1;
        }
        const std::string name = fmt::format("occupancy of wisps, a voxel in {}", one_in);
        hold(name, "share of samples > 0 lost", share_lost(volume, cells_of(volume), 0, kPoints),
             0);
        const OccupiedCells thesis = test::cells_of_thesis(volume, 0);
        const double lost = share_lost(volume, thesis, 0, kPoints);
        EXPECT_GT(lost, 0.5);
        hold(name + ", as in thesis", "share of samples > 0 lost", lost, 1);
    }
}

TEST(OccupancyHardCase, OccupancyCloudAcrossTheSeam) {
    Volume volume = test::volume_of({{32, 32, 16}, 4});
    for (int z = 0; z < 16; ++z) {
        for (int y = 0; y < 32; ++y) volume.at(31, y, z) = 0.5F;
    }
    const OccupiedCells cells = cells_of(volume);
    hold("occupancy of a wall at the seam along x", "cells on both sides of it, difference",
         std::fabs(static_cast<double>(count(cells)) - 2 * 8 * 4), 0);
    const auto leaps = leap_distance(cells);
    hold("leap distance of a wall at the seam", "3 in the middle, difference",
         std::fabs(3.0 - *std::max_element(leaps.begin(), leaps.end())), 0);
    hold("occupancy of a wall at the seam", "share of samples > 0 lost",
         share_lost(volume, cells, 0, 200000), 0);
}

TEST(OccupancyHardCase, OccupancySizesThatCellsDoNotDivide) {
    double unlike = 0;
    double lost = 0;
    int volumes = 0;
    for (const CellGrid& grid : {CellGrid{{33, 31, 30}, 4},
                                 {{17, 15, 9}, 8},
                                 {{35, 1, 17}, 16},
                                 {{3, 2, 1}, 4},
                                 {{1, 1, 1}, 16},
                                 {{5, 3, 2}, 16},
                                 {{2, 2, 2}, 1}}) {
        Volume volume = test::volume_of(grid);
        for (std::size_t i = 0; i < volume.voxels.size(); ++i) {
            volume.voxels[i] =
                test::value_of(i % 3 == 0 ? test::Values::uniform : test::Values::sparse,
                               test::mixed(static_cast<std::uint32_t>(i)));
        }
        for (const float threshold : {0.0F, 0.3F, 0.5F}) {
            unlike += unlike_referee(volume, threshold);
            if (count(cells_of(volume, threshold)) == 0) continue;
            lost += share_lost(volume, cells_of(volume, threshold), threshold, 20000);
            ++volumes;
        }
    }
    hold("occupancy of odd sizes, and smaller than a cell", "integers, cells unlike", unlike, 0);
    hold("occupancy of odd sizes, and smaller than a cell",
         fmt::format("share of samples lost, {} grids", volumes), lost, 0);
}

TEST(OccupancyHardCase, OccupancyThresholdThatVoxelsHold) {
    // Multiples of 1/8: voxels and means that are equal to thresholds, which is not enough.
    Volume volume = test::volume_of({{29, 30, 31}, 4});
    for (std::size_t i = 0; i < volume.voxels.size(); ++i) {
        volume.voxels[i] =
            test::value_of(test::Values::steps, test::mixed(static_cast<std::uint32_t>(i / 40)));
    }
    volume.voxels[1234] = 1;
    double unlike = 0;
    for (int i = 0; i <= 64; ++i) {
        unlike += unlike_referee(volume, static_cast<float>(i) / 64);
    }
    hold("occupancy at thresholds 0, 1/64 ... 1", "integers, cells unlike", unlike, 0);
    hold("occupancy at threshold 1, which a voxel holds", "0, occupied cells",
         static_cast<double>(count(cells_of(volume, 1))), 0);
    EXPECT_EQ(count(cells_of(volume, std::nextafter(1.0F, 0.0F))), 1);
}

TEST(OccupancyHardCase, OccupancyNegativeValues) {
    Volume volume = test::volume_of({{24, 24, 24}, 4}, -1);
    EXPECT_EQ(count(cells_of(volume)), 0);
    volume.at(8, 9, 9) = 1;
    // Half way to its neighbours it is 0, which is not enough.
    hold("occupancy of a positive voxel among negative ones", "its own cell, difference",
         std::fabs(static_cast<double>(count(cells_of(volume))) - 1), 0);
    volume.at(8, 9, 9) = std::nextafter(1.0F, 2.0F);
    hold("occupancy of the next float among negative ones", "the face's cells, difference",
         std::fabs(static_cast<double>(count(cells_of(volume))) - 2), 0);
}

// Means that no float is: the least above must not be below them, nor 0.
TEST(OccupancyHardCase, OccupancyMeansThatRound) {
    const float above_one = std::nextafter(1.0F, 2.0F);
    Volume volume = test::volume_of({{8, 8, 8}, 4}, 1);
    volume.at(4, 1, 1) = above_one;
    double unlike = 0;
    for (const float threshold : {std::nextafter(1.0F, 0.0F), 1.0F, above_one}) {
        unlike += unlike_referee(volume, threshold);
    }
    hold("occupancy of 1 + 2^-23 among ones", "integers, cells unlike", unlike, 0);
    // 1 + 2^-60 is no double; nor is the mean of 1, -1 and 2^-60.
    Volume wide = test::volume_of({{8, 8, 8}, 4});
    wide.at(3, 1, 1) = 2;
    wide.at(4, 1, 1) = 0x1p-59F;
    unlike = unlike_referee(wide, 1) + unlike_referee(wide, 2);
    wide.at(3, 2, 1) = -2;
    unlike += unlike_referee(wide, 1) + unlike_referee(wide, 0);
    wide.at(3, 1, 1) = 0x1p-60F;
    wide.at(4, 1, 1) = -0x1p-60F;
    unlike += unlike_referee(wide, 0);
    hold("occupancy of 2 beside 2^-59", "integers, cells unlike", unlike, 0);
    // Sums beyond the largest float.
    const float largest = std::numeric_limits<float>::max();
    const CellRanges ranges = ranges_of(test::volume_of({{8, 8, 8}, 4}, largest));
    hold("cell range of the largest float", "itself, cells unlike",
         8 - static_cast<double>(std::count(ranges.maximum.begin(), ranges.maximum.end(), largest)),
         0);
}

TEST(OccupancyHardCase, OccupancyDenormals) {
    Volume volume = test::volume_of({{21, 22, 23}, 4});
    for (std::size_t i = 0; i < volume.voxels.size(); ++i) {
        const std::uint32_t bits = test::mixed(static_cast<std::uint32_t>(i));
        if (bits % 16 == 0) volume.voxels[i] = test::value_of(test::Values::denormals, bits / 16);
    }
    double unlike = 0;
    for (const float threshold : {0.0F, 0x1p-149F, 0x1p-148F}) {
        unlike += unlike_referee(volume, threshold, 149);
    }
    hold("occupancy of denormals", "integers, cells unlike", unlike, 0);
}

}  // namespace
}  // namespace skybake::occupancy
