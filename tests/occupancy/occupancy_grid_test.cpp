// The asset: what its channels hold, what pixel types do to them, and that the baker finds its own
// faults.
#include "bakers/assets/occupancy/occupancy_grid.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <cmath>

#include "bakers/assets/occupancy/occupancy_proof.h"
#include "bakers/field/pixel_type.h"
#include "bakers/occupancy/occupied_cells.h"
#include "config/assets/occupancy.h"
#include "tests/clouds/clouds.h"
#include "tests/support/volumes.h"

namespace skybake::occupancy {
namespace {

using config::OccupancyContent;
using config::OccupancyFilter;

// A cloud volume with a level that need not be surveyed.
struct Subject {
    std::shared_ptr<cloud::CloudField> field;
    Baked volume;

    Subject(const test::CloudCase& any, PixelType type)
        : field(std::make_shared<cloud::CloudField>(any.plan())) {
        volume.mapping = "layer";
        volume.axes.resize(3);
        volume.axes[0].wrap = volume.axes[1].wrap = AxisWrap::repeat;
        volume.channel_names = field->plan().channels == 1
                                   ? std::vector<std::string>{"Y"}
                                   : std::vector<std::string>{"R", "G", "B", "A"};
        volume.channel_names.resize(static_cast<std::size_t>(field->plan().channels));
        volume.pixel_type = type;
        volume.voxel_size_m = {1, 1, 2};
        volume.up_axis = "+z";
        Level level;
        level.size = any.size;
        level.voxels = field;
        volume.levels.push_back(level);
    }
};

OccupancyBake all_contents(int cell) {
    OccupancyBake bake;
    bake.of = "c";
    bake.cell = cell;
    bake.contents = {OccupancyContent::occupied, OccupancyContent::leap, OccupancyContent::minimum,
                     OccupancyContent::maximum};
    return bake;
}

test::Planes planes_of(const Baked& volume, std::size_t level = 0) {
    return test::filled(*volume.levels[level].voxels, {{}, volume.levels[level].size},
                        static_cast<int>(volume.channel_names.size()));
}

TEST(OccupancyGrid, HoldsWhatItsVolumeHas) {
    EXPECT_TRUE(rc::check([] {
        test::CloudCase any = test::any_cloud();
        any.cloud.threshold_at = config::ThresholdAt::bake;
        any.cloud.towers.clear();
        const Subject subject(any, PixelType::half);
        OccupancyBake bake = all_contents(*rc::gen::element(1, 2, 4, 8, 16));
        bake.mips = 3;
        const auto outcome = bake_occupancy({subject.volume, 0}, bake, {}, {});
        RC_ASSERT(outcome.value.has_value());
        const Baked& grid = *outcome.value;
        RC_ASSERT(grid.levels.size() == 3);
        const CellGrid cells{any.size, bake.cell};
        RC_ASSERT(grid.levels[0].size == cells.size());
        const test::Planes found = planes_of(grid);
        const test::Planes voxels = planes_of(subject.volume);
        for (int i = 0; i < 50; ++i) {
            std::array<int, 3> voxel;
            std::array<int, 3> cell;
            for (std::size_t a = 0; a < 3; ++a) {
                voxel[a] = *rc::gen::inRange(0, any.size[a]);
                cell[a] = voxel[a] / bake.cell;
            }
            const float value = round_to_pixel_type(
                voxels[0][index_of(any.size, voxel[0], voxel[1], voxel[2])], PixelType::half);
            const std::size_t at = index_of(cells.size(), cell[0], cell[1], cell[2]);
            RC_ASSERT(found[2][at] <= value);
            RC_ASSERT(found[3][at] >= value);
            RC_ASSERT(found[0][at] == (found[3][at] > 0 ? 1.0f : 0.0f));
            RC_ASSERT((found[1][at] == 0) == (found[0][at] == 1));
            // A level's cell holds those below it.
            const test::Planes coarser = planes_of(grid, 1);
            const std::size_t above =
                index_of(grid.levels[1].size, cell[0] / 2, cell[1] / 2, cell[2] / 2);
            RC_ASSERT(coarser[0][above] >= found[0][at]);
            RC_ASSERT(coarser[2][above] <= found[2][at]);
            RC_ASSERT(coarser[3][above] >= found[3][at]);
        }
    }));
}

// Along x, three tiles of a volume of `voxels` side by side, each voxel looked up in the grid as
// its axis says: how many lie in a cell whose maximum is below them.
int misplaced_voxels(int voxels) {
    test::CloudCase any = test::plain_case({voxels, 8, 8});
    const Subject subject(any, PixelType::float32);
    const auto grid = bake_occupancy({subject.volume, 0}, all_contents(4), {}, {});
    EXPECT_TRUE(grid.value.has_value());
    const std::array<int, 3> cells = grid.value->levels[0].size;
    const std::vector<float> maximum = planes_of(*grid.value)[3];
    const std::vector<float> values = planes_of(subject.volume)[0];
    const AxisMapping& axis = grid.value->axes[0];
    int misplaced = 0;
    for (int x = 0; x < 3 * voxels; ++x) {
        const double u = (x + 0.5 - axis.first) / (axis.last - axis.first);
        const int cell = static_cast<int>((u - std::floor(u)) * cells[0]);
        for (int yz = 0; yz < 64; ++yz) {
            const float value = values[index_of(any.size, x % voxels, yz % 8, yz / 8)];
            const float most = maximum[index_of(cells, cell, yz % 8 / 4, yz / 8 / 4)];
            misplaced += value > most ? 1 : 0;
        }
    }
    return misplaced;
}

// Recipes whose cells do not divide the volume are refused (E0150): a grid of theirs repeats with a
// longer period than the volume.
TEST(OccupancyGrid, RepeatsAsItsVolumeDoesWhereCellsDivideIt) {
    EXPECT_EQ(misplaced_voxels(12), 0);
    EXPECT_EQ(misplaced_voxels(16), 0);
    EXPECT_GT(misplaced_voxels(10), 0);
}

TEST(OccupancyGrid, IsTheSameOnAnyNumberOfThreads) {
    test::CloudCase any = test::plain_case({70, 33, 21});
    const Subject subject(any, PixelType::half);
    const auto hash = [&](int threads) {
        return bake_occupancy({subject.volume, 0}, all_contents(4), {.threads = threads}, {})
            .value->levels[0]
            .content_hash;
    };
    EXPECT_EQ(hash(1), hash(2));
    EXPECT_EQ(hash(1), hash(7));
}

TEST(OccupancyGrid, AsUnormHasLeapsOver255) {
    const test::CloudCase any = test::plain_case({40, 40, 40});
    const Subject subject(any, PixelType::half);
    OccupancyBake bake = all_contents(2);
    bake.contents = {OccupancyContent::leap};
    bake.pixel_type = PixelType::unorm8;
    const auto grid = bake_occupancy({subject.volume, 0}, bake, {}, {});
    ASSERT_TRUE(grid.value);
    bake.pixel_type = PixelType::half;
    const auto as_half = bake_occupancy({subject.volume, 0}, bake, {}, {});
    const test::Planes unorm = planes_of(*grid.value);
    const test::Planes half = planes_of(*as_half.value);
    EXPECT_EQ(grid.value->channel_names, std::vector<std::string>{"Y"});
    for (std::size_t i = 0; i < half[0].size(); ++i) {
        EXPECT_EQ(std::round(unorm[0][i] * 255), half[0][i]);
    }
}

TEST(OccupancyGrid, OfTheThesisSaysWhatItLoses) {
    test::CloudCase any = test::plain_case({64, 64, 16});
    // One-voxel wisps: a hard edge just below what few voxels reach.
    any.cloud.threshold = 0.72;
    any.cloud.edge_softness = 0;
    any.base = test::noise_of({test::perlin({{16, 16, 4}})});
    const Subject subject(any, PixelType::half);
    OccupancyBake bake = all_contents(4);
    bake.rule = config::OccupancyRule::thesis;
    const auto outcome = bake_occupancy({subject.volume, 0}, bake, {}, {});
    ASSERT_TRUE(outcome.value);
    const auto& details = outcome.value->details;
    const auto unsafe = std::find_if(details.begin(), details.end(), [](const auto& detail) {
        return detail.first == "unsafe_cells";
    });
    ASSERT_NE(unsafe, details.end());
    EXPECT_GT(std::get<double>(unsafe->second), 0);
}

// The proof, with a cell cleared by hand.
TEST(OccupancyProof, FindsALostCell) {
    for (const auto filter :
         {OccupancyFilter::nearest, OccupancyFilter::trilinear, OccupancyFilter::tricubic}) {
        EXPECT_TRUE(rc::check([filter] {
            const test::CloudCase any = test::any_cloud();
            const Subject subject(any, PixelType::half);
            const ChannelSource source{*subject.field, 0, subject.field->plan().channels,
                                       PixelType::half};
            const float threshold = *rc::gen::element(0.0f, 0.2f);
            const CellGrid grid{any.size, *rc::gen::element(1, 2, 4, 8)};
            const CellRanges ranges = cell_ranges(source, grid, filter, {});
            OccupiedCells cells = occupied_cells(ranges, threshold);
            RC_ASSERT(!find_lost_cell(source, grid, filter, cells, threshold, {}));
            std::vector<std::size_t> on;
            for (std::size_t i = 0; i < cells.occupied.size(); ++i) {
                if (cells.occupied[i] != 0) on.push_back(i);
            }
            if (on.empty()) return;
            const std::size_t cleared = on[*rc::gen::inRange<std::size_t>(0, on.size())];
            cells.occupied[cleared] = 0;
            const auto lost = find_lost_cell(source, grid, filter, cells, threshold, {});
            RC_ASSERT(lost.has_value());
            RC_ASSERT(index_of(cells.size, lost->cell[0], lost->cell[1], lost->cell[2]) == cleared);
            RC_ASSERT(lost->value > double{threshold});
        }));
    }
}

// A voxel in a corner, which the filter takes across the seams along x and y into other cells.
TEST(OccupancyProof, FindsCellsThatOnlyTheFilterReaches) {
    const CellGrid grid{{18, 14, 11}, 4};
    const testing::FunctionVoxels voxels(
        [](int x, int y, int z, int) { return x == 0 && y == 0 && z == 4 ? 1.0F : 0.0F; });
    const ChannelSource source{voxels};
    for (const auto filter : {OccupancyFilter::trilinear, OccupancyFilter::tricubic}) {
        const OccupiedCells exact = occupied_cells(cell_ranges(source, grid, filter, {}), 0);
        int reached = 0;
        for (std::size_t i = 0; i < exact.occupied.size(); ++i) {
            if (exact.occupied[i] == 0) continue;
            ++reached;
            OccupiedCells cells = exact;
            cells.occupied[i] = 0;
            const auto lost = find_lost_cell(source, grid, filter, cells, 0, {});
            ASSERT_TRUE(lost) << i;
            const auto [x, y, z] = lost->cell;
            EXPECT_EQ(index_of(cells.size, x, y, z), i);
            const double faces = (x == 0 ? 1 : 0.5) * (y == 0 ? 1 : 0.5) * (z == 1 ? 1 : 0.5);
            EXPECT_EQ(lost->value, filter == OccupancyFilter::trilinear ? faces : 1);
        }
        EXPECT_EQ(reached, 8);
    }
}

TEST(StoredOutwards, IsTheNearestOnTheRightSide) {
    EXPECT_TRUE(rc::check([] {
        const auto value =
            static_cast<float>(test::any_number(-2, 2) * std::pow(2.0, *rc::gen::inRange(-30, 10)));
        const float up = stored_up(value, PixelType::half);
        const float down = stored_down(value, PixelType::half);
        RC_ASSERT(up >= value && down <= value);
        RC_ASSERT(round_to_pixel_type(up, PixelType::half) == up);
        RC_ASSERT(round_to_pixel_type(down, PixelType::half) == down);
        // Neighbours, or the value itself: nothing between them is a half.
        RC_ASSERT(up == down ||
                  round_to_pixel_type((double{up} + double{down}) / 2, PixelType::half) == up ||
                  round_to_pixel_type((double{up} + double{down}) / 2, PixelType::half) == down);
        const auto share = static_cast<float>(test::any_number(0, 1));
        for (const PixelType type : {PixelType::unorm8, PixelType::unorm16}) {
            // Compares the steps that are stored, not the floats nearest to those.
            const double steps = type == PixelType::unorm8 ? 255 : 65535;
            RC_ASSERT(std::round(stored_up(share, type) * steps) >= double{share} * steps);
            RC_ASSERT(std::round(stored_down(share, type) * steps) <= double{share} * steps);
            RC_ASSERT(round_to_pixel_type(stored_up(share, type), type) == stored_up(share, type));
            RC_ASSERT(stored_up(share, type) - stored_down(share, type) <= 1.001 / 255);
        }
    }));
}

}  // namespace
}  // namespace skybake::occupancy
