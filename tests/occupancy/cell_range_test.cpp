#include "bakers/occupancy/cell_range.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <atomic>
#include <bit>
#include <limits>

#include "bakers/math/quadrature.h"
#include "bakers/occupancy/cell_row_kernel.h"
#include "bakers/occupancy/exact_extremes.h"
#include "config/assets/occupancy_filter.h"
#include "tests/noise/every_target.h"
#include "tests/occupancy/exact_range.h"
#include "tests/support/cancelled_at.h"
#include "tests/support/volumes.h"

namespace skybake::occupancy {
namespace {

using config::OccupancyFilter;
using test::Values;
using test::Volume;

bool same_ranges(const CellRanges& a, const CellRanges& b) {
    return a.size == b.size && test::same_bits(a.minimum, b.minimum) &&
           test::same_bits(a.maximum, b.maximum);
}

CellRanges ranges_of(const Volume& volume, OccupancyFilter filter) {
    return cell_ranges(volume.voxels.data(), volume.grid, filter);
}

// In order of the cells.
template <class Visit>
void for_each_cell(const std::array<int, 3>& size, const Visit& visit) {
    std::size_t index = 0;
    testing::for_each_voxel(size, [&](int i, int j, int k) {
        visit(std::array<int, 3>{i, j, k}, index++);
    });
}

// Looks at every voxel of a footprint: a cell's own voxels, and for tricubic lookups the two beyond.
CellRanges footprint_ranges(const Volume& volume, int beyond) {
    CellRanges ranges{volume.grid.size(), {}, {}};
    const std::array<int, 3>& size = volume.grid.voxels;
    for_each_cell(ranges.size, [&](const std::array<int, 3>& cell, std::size_t) {
        std::array<Span, 3> spans;
        std::array<int, 3> counts{};
        for (std::size_t a = 0; a < 3; ++a) {
            spans[a] = volume.grid.voxels_of(a, cell[a]);
            counts[a] = spans[a].count() + 2 * beyond;
        }
        float least = std::numeric_limits<float>::infinity();
        float most = -least;
        testing::for_each_voxel(counts, [&](int x, int y, int z) {
            const float voxel = volume.at(wrapped(spans[0].first - beyond + x, size[0]),
                                          wrapped(spans[1].first - beyond + y, size[1]),
                                          clamped(spans[2].first - beyond + z, size[2]));
            least = std::min(least, voxel);
            most = std::max(most, voxel);
        });
        ranges.minimum.push_back(least + 0.0F);
        ranges.maximum.push_back(most + 0.0F);
    });
    return ranges;
}

CellRanges exact_ranges(const Volume& volume, int unit) {
    CellRanges ranges{volume.grid.size(), {}, {}};
    for_each_cell(ranges.size, [&](const std::array<int, 3>& cell, std::size_t) {
        const test::ExactRange range = test::exact_range(volume, cell, unit);
        ranges.minimum.push_back(-test::least_float_above(-range.least, unit + 3) + 0.0F);
        ranges.maximum.push_back(test::least_float_above(range.most, unit + 3));
    });
    return ranges;
}

TEST(CellRange, IsTheExactRangeRoundedOutwardsOnEveryTarget) {
    EXPECT_TRUE(rc::check([] {
        const Values values = test::any_values();
        const Volume volume = test::any_volume(24, values, *rc::gen::inRange(0, 4) == 0);
        const CellRanges wanted = exact_ranges(volume, test::unit_of(values));
        bool same = true;
        test::on_every_target([&](const char*) {
            same = same && same_ranges(ranges_of(volume, OccupancyFilter::trilinear), wanted);
        });
        RC_ASSERT(same);
    }));
}

TEST(CellRange, FootprintsAreTheReferencesOnEveryTarget) {
    EXPECT_TRUE(rc::check([] {
        const Volume volume = test::any_volume(24, test::any_values());
        for (const OccupancyFilter filter : {OccupancyFilter::nearest, OccupancyFilter::tricubic}) {
            const CellRanges wanted =
                footprint_ranges(volume, filter == OccupancyFilter::tricubic ? 2 : 0);
            bool same = true;
            test::on_every_target([&](const char*) {
                same = same && same_ranges(ranges_of(volume, filter), wanted);
            });
            RC_ASSERT(same);
        }
    }));
}

TEST(CellRange, LongRowsOfWholeVectors) {
    for (const int cell : {1, 2, 4, 8, 16}) {
        for (const int length : {64, 127, 128, 129, 200}) {
            Volume volume = test::volume_of({{length, 9, 5}, cell});
            for (std::size_t i = 0; i < volume.voxels.size(); ++i) {
                volume.voxels[i] = test::share_of(test::mixed(static_cast<std::uint32_t>(i)));
            }
            const CellRanges wanted = exact_ranges(volume, 84);
            test::on_every_target([&](const char* name) {
                EXPECT_TRUE(same_ranges(ranges_of(volume, OccupancyFilter::trilinear), wanted))
                    << name << " cell " << cell << " length " << length;
            });
        }
    }
}

// Lookups at random, and at and beside the faces, which belong to two cells and more.
TEST(CellRange, HoldsEveryLookup) {
    EXPECT_TRUE(rc::check([] {
        const Volume volume = test::any_volume(40, test::any_values(), *rc::gen::arbitrary<bool>());
        double largest = 0;
        for (const float voxel : volume.voxels) {
            largest = std::max(largest, std::fabs(double{voxel}));
        }
        const auto first = *rc::gen::inRange(0, 1 << 20);
        for (const OccupancyFilter filter : test::kFilters) {
            const CellRanges ranges = ranges_of(volume, filter);
            for (int n = 0; n < 500; ++n) {
                std::array<double, 3> place = low_discrepancy_point(first + n);
                std::array<int, 3> cell{};
                for (std::size_t a = 0; a < 3; ++a) {
                    cell[a] = static_cast<int>(place[a] * ranges.size[a]);
                    const Span span = volume.grid.voxels_of(a, cell[a]);
                    const double within = place[a] * ranges.size[a] - cell[a];
                    place[a] = span.first + within * span.count();
                    // A nearest lookup at the upper face is one in the next cell.
                    if (filter == OccupancyFilter::nearest) continue;
                    if (n % 5 == static_cast<int>(a)) place[a] = span.last;
                    if (n % 7 == static_cast<int>(a)) place[a] = span.first;
                }
                const double value = test::lookup(volume, filter, place);
                const double rounding = 1e-14 * largest;
                const std::size_t index = index_of(ranges.size, cell[0], cell[1], cell[2]);
                RC_ASSERT(value <= double{ranges.maximum[index]} + rounding);
                RC_ASSERT(value >= double{ranges.minimum[index]} - rounding);
            }
        }
    }));
}

TEST(CellRange, IsReachedByLookupsOnAFineLattice) {
    // Voxels, faces, edges and corners are among multiples of half a voxel.
    EXPECT_TRUE(rc::check([] {
        const Volume volume = test::any_volume(9, Values::signs);
        const CellRanges ranges = ranges_of(volume, OccupancyFilter::trilinear);
        for_each_cell(ranges.size, [&](const std::array<int, 3>& cell, std::size_t index) {
            double most = -2;
            double least = 2;
            std::array<Span, 3> spans;
            for (std::size_t a = 0; a < 3; ++a) spans[a] = volume.grid.voxels_of(a, cell[a]);
            for (int z = 4 * spans[2].first; z <= 4 * spans[2].last; ++z) {
                for (int y = 2 * spans[1].first; y <= 2 * spans[1].last; ++y) {
                    for (int x = 2 * spans[0].first; x <= 2 * spans[0].last; ++x) {
                        const double value = test::lookup(volume, OccupancyFilter::trilinear,
                                                          {x / 2.0, y / 2.0, z / 4.0});
                        most = std::max(most, value);
                        least = std::min(least, value);
                    }
                }
            }
            RC_ASSERT(rounded_up(most) == ranges.maximum[index]);
            RC_ASSERT(rounded_down(least) == ranges.minimum[index]);
        });
    }));
}

// Asks for boxes within the volume only, never for those known to be empty, and for one channel.
class StrictSource : public VoxelSource {
  public:
    explicit StrictSource(const Volume& volume) : volume_(volume) {}

    void fill(const VoxelBox& box, const std::vector<float*>& channels) const override {
        ++fills;
        EXPECT_FALSE(is_empty(box));
        ASSERT_EQ(channels.size(), 3U);
        EXPECT_EQ(channels[0], nullptr);
        EXPECT_EQ(channels[2], nullptr);
        for (std::size_t a = 0; a < 3; ++a) {
            EXPECT_GE(box.origin[a], 0);
            EXPECT_GE(box.size[a], 1);
            EXPECT_LE(box.origin[a] + box.size[a], volume_.grid.voxels[a]);
        }
        float* out = channels[1];
        visit(box, [&](float voxel) { *out++ = voxel; });
    }

    bool is_empty(const VoxelBox& box) const override {
        bool empty = true;
        visit(box, [&](float voxel) { empty = empty && voxel == 0; });
        return empty;
    }

    mutable std::atomic<int> fills = 0;

  private:
    template <class Visit>
    void visit(const VoxelBox& box, const Visit& take) const {
        for (int z = box.origin[2]; z < box.origin[2] + box.size[2]; ++z) {
            for (int y = box.origin[1]; y < box.origin[1] + box.size[1]; ++y) {
                for (int x = box.origin[0]; x < box.origin[0] + box.size[0]; ++x) {
                    take(volume_.at(x, y, z));
                }
            }
        }
    }

    const Volume& volume_;
};

// Large enough for several blocks, with layers of nothing.
Volume layered_volume(const CellGrid& grid) {
    Volume volume = test::volume_of(grid);
    for (int z = 0; z < grid.voxels[2]; ++z) {
        if (z % 24 >= 9) continue;
        testing::for_each_texel(grid.voxels[0], grid.voxels[1], [&](int x, int y) {
            volume.at(x, y, z) = testing::sample_voxel(x, y, z, 1);
        });
    }
    return volume;
}

TEST(CellRangeOfSource, IsTheRangeOfStoredValuesForAnyThreads) {
    for (const CellGrid& grid :
         {CellGrid{{97, 83, 66}, 4}, {{64, 3, 1500}, 8}, {{1, 700, 700}, 2}, {{5, 2, 3}, 16}}) {
        const Volume volume = layered_volume(grid);
        const StrictSource source(volume);
        for (const PixelType type : {PixelType::float32, PixelType::half, PixelType::unorm8}) {
            Volume stored = volume;
            round_values(stored.voxels.data(), stored.voxels.size(), type);
            for (const OccupancyFilter filter : test::kFilters) {
                const CellRanges wanted = ranges_of(stored, filter);
                for (const int threads : {1, 2, 7}) {
                    const CellRanges found = cell_ranges(ChannelSource{source, 1, 3, type}, grid,
                                                         filter, BakeOptions{threads});
                    EXPECT_TRUE(same_ranges(found, wanted));
                }
            }
        }
        EXPECT_TRUE(
            same_ranges(cell_ranges(volume.voxels.data(), grid, OccupancyFilter::trilinear, 7),
                        ranges_of(volume, OccupancyFilter::trilinear)));
    }
}

TEST(CellRangeOfSource, TellsHowFarItIsAndStops) {
    const Volume volume = layered_volume({{97, 83, 66}, 4});
    const StrictSource source(volume);
    BakeOptions options{1};
    testing::CancelledAt never("cells", 1 << 20);
    options.progress = &never;
    cell_ranges({source, 1, 3}, volume.grid, OccupancyFilter::trilinear, options);
    EXPECT_EQ(never.last, 1);
    testing::CancelledAt first("cells", 1);
    options.progress = &first;
    cell_ranges({source, 1, 3}, volume.grid, OccupancyFilter::trilinear, options);
    EXPECT_GT(first.last, 0);
    EXPECT_LT(first.last, 1);
}

TEST(OutwardRounding, IsTheNearestFloatOnTheRightSide) {
    EXPECT_TRUE(rc::check([] {
        const auto bits = *rc::gen::arbitrary<std::uint32_t>();
        const auto value = std::bit_cast<float>(bits);
        if (!std::isfinite(value) || std::fabs(value) == std::numeric_limits<float>::max()) return;
        const float next = std::nextafter(value, std::numeric_limits<float>::infinity());
        RC_ASSERT(rounded_up(value) == value);
        RC_ASSERT(rounded_down(value) == value);
        for (const double share : {1e-6, 0.4, 0.5, 0.6, 1 - 1e-6}) {
            const double between = value + share * (double{next} - double{value});
            RC_ASSERT(rounded_up(between) == next);
            RC_ASSERT(rounded_down(between) == value);
        }
    }));
    EXPECT_FALSE(std::signbit(rounded_up(-0.0)));
    EXPECT_FALSE(std::signbit(rounded_up(-0x1p-152)));
    EXPECT_FALSE(std::signbit(rounded_down(-0.0)));
    EXPECT_EQ(rounded_up(0x1p-152), 0x1p-149F);
    EXPECT_EQ(rounded_down(-0x1p-152), -0x1p-149F);
}

TEST(Magnitudes, SayWhetherMeansAreExact) {
    const auto exact = [](std::vector<float> values) {
        values.resize(37, 0.0F);
        return means_are_exact(magnitudes_of(values.data(), values.size(), values.data()));
    };
    EXPECT_TRUE(exact({}));
    EXPECT_TRUE(exact({1, 0x1.fffffep26F}));
    EXPECT_FALSE(exact({1, 0x1p27F}));
    EXPECT_FALSE(exact({0x1.fffffep-1F, -0x1p26F}));
    EXPECT_TRUE(exact({0x1p-149F, 0x1p-100F}));
    EXPECT_FALSE(exact({0x1p-149F, 0x1p-99F}));
    test::on_every_target([](const char* name) {
        for (std::size_t count = 1; count < 70; ++count) {
            std::vector<float> values(count, 0.0F);
            EXPECT_TRUE(magnitudes_of(values.data(), count, values.data()).all_zero()) << name;
            values[count - 1] = -3;
            values[0] = 2;
            const Magnitudes found = magnitudes_of(values.data(), count, values.data());
            EXPECT_EQ(found.smallest, std::bit_cast<std::uint32_t>(2.0F)) << name << count;
            EXPECT_EQ(found.largest, std::bit_cast<std::uint32_t>(count < 2 ? 2.0F : 3.0F))
                << name << count;
        }
    });
}

}  // namespace
}  // namespace skybake::occupancy
