#include "config/assets/occupancy.h"

#include <fmt/format.h>

#include <algorithm>

#include "config/assets/asset_fields.h"
#include "config/assets/asset_kind.h"
#include "config/assets/cloud_volume.h"
#include "config/assets/file_decoder.h"
#include "config/assets/source_volume.h"
#include "config/fields/fields.h"
#include "config/fields/section_decoder.h"

namespace skybake::config {
namespace {

constexpr Choice filter_choices[] = {
    {OccupancyFilter::nearest, "nearest", "the voxel in which a point lies"},
    {OccupancyFilter::trilinear, "trilinear", "between the eight nearest voxels, as GPUs do"},
    {OccupancyFilter::tricubic, "tricubic", "cubic B-spline over 64 voxels"},
};

constexpr Choice rule_choices[] = {
    {OccupancyRule::exact, "exact",
     "a cell is empty only where no filtered sample in it is above 0"},
    {OccupancyRule::thesis, "thesis",
     "samples 8 of 64 voxels of a cell and marks a ring around occupied cells; loses thin wisps"},
};

constexpr Choice occupancy_content_choices[] = {
    {OccupancyContent::occupied, "occupied", "1, or 0 where the cell is empty"},
    {OccupancyContent::leap, "leap",
     "cells to the nearest occupied one, along the longest of the three axes"},
    {OccupancyContent::minimum, "minimum", "the smallest filtered sample in the cell"},
    {OccupancyContent::maximum, "maximum", "the largest filtered sample in the cell"},
};

const Row<OccupancyBake> occupancy_table[] = {
    {source_volume_field, &OccupancyBake::of},
    {source_channel_field, &OccupancyBake::channel},
    {"cell", Kind::power_of_two, &OccupancyBake::cell, "voxels along each edge of a cell",
     cell_range, Default{"2"}, Hint{"1, 2, 4, 8 or 16"}},
    {"filter", Kind::choice, &OccupancyBake::filter, "how the runtime looks the volume up",
     filter_choices, Default{R"("trilinear")"}},
    {"rule", Kind::choice, &OccupancyBake::rule, "when a cell is empty", rule_choices,
     Default{R"("exact")"}, Cited{olajos_2016}},
    {"contents", Kind::choice_list, &OccupancyBake::contents,
     "what the one, three or four channels hold, in this order", occupancy_content_choices,
     Default{R"(["occupied", "leap", "minimum", "maximum"])"}},
};

// Returns the number of channels, or 1 if it cannot be told.
std::size_t check_occupancy_contents(const DecodedSection& bake, Decoder& decoder) {
    const auto* contents = bake.value<std::vector<ChoiceIndex>>("contents");
    if (!contents) return 1;
    if (contents->size() == 2) {
        decoder.report(
            "E0129", bake, "contents", "has two channels",
            "a picture has one, three or four channels: add one, or bake them as two assets");
    }
    return contents->size();
}

int most_levels(VoxelCounts cells) {
    const auto is_odd = [](int count) { return count > 1 && count % 2 != 0; };
    const auto is_one = [](int count) { return count == 1; };
    int levels = 1;
    while (std::ranges::none_of(cells, is_odd) && !std::ranges::all_of(cells, is_one)) {
        for (int& count : cells) count = (count + 1) / 2;
        ++levels;
    }
    return levels;
}

// If a level has an odd number of cells, the next level has half of it, rounded up, and spans
// more than the level before. Then one texture coordinate does not fit both levels.
// "all" is as many levels as there are before that.
void check_halvings(DecodedSection& bake, const VoxelCounts& cells, Decoder& decoder) {
    if (bake.whole("mips") == 0) bake.at("mips").value = double{1} * most_levels(cells);
    const int halvings = bake.whole("mips").value_or(1) - 1;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        int left = cells[axis];
        int done = 0;
        for (; done < halvings && left % 2 == 0; ++done) left /= 2;
        if (done >= halvings || left == 1) continue;
        return decoder.diagnostics.error(
            "E0150", bake.place_of("mips"),
            fmt::format("the {} cells of [{}] along {} cannot be halved {} time{}", cells[axis],
                        bake.path, "xyz"[axis], halvings, halvings == 1 ? "" : "s"),
            fmt::format("use at most {} levels, or another size", done + 1));
    }
}

// Fills in the number of `mips`. It reports two contents (E0129), cells that do not tile as the volume
// does (E0150), and what find_cells and resolve_cells report.
//
// The volume repeats along x and y. Cells that stick out of the tile would repeat with another
// period than the volume. A runtime that repeats both would then find other cells than those
// that contain its voxels. A single cell that holds the whole tile is the same everywhere and
// therefore allowed.
void resolve_occupancy(DecodedSection& bake, const RecipeSoFar& recipe, Decoder& decoder) {
    const std::size_t channels = check_occupancy_contents(bake, decoder);
    const auto cells =
        find_cells(bake, recipe, "occupancy, whose empty cells must stay empty", decoder);
    if (!cells) return;
    check_halvings(bake, cells->counts, decoder);
    resolve_cells(bake, *cells, channels, recipe, decoder);
    check_tiling(bake, *cells, true, decoder);
}

}  // namespace

AssetKind asset_kind(Tag<OccupancyBake>) {
    return make_asset_kind<OccupancyBake>(
        {.name = "occupancy",
         .documentation =
             "which cells of a cloud volume are empty, and how far a ray may leap from them",
         .of_another_bake = true},
        with_file_fields(
            occupancy_table,
            {.formats = R"(["exr"])",
             .mips = "levels of the pyramid of minima and maxima, with the cells themselves"}),
        reads_of_its_source, resolve_occupancy);
}

}  // namespace skybake::config
