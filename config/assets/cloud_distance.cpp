#include "config/assets/cloud_distance.h"

#include "config/assets/asset_fields.h"
#include "config/assets/asset_kind.h"
#include "config/assets/cloud_volume.h"
#include "config/assets/source_volume.h"
#include "config/fields/fields.h"
#include "config/fields/section_decoder.h"
#include "config/sections/parameters.h"

namespace skybake::config {
namespace {

constexpr std::string_view schneider_2023 =
    "Schneider 2023, Nubis Cubed: Methods (and madness) to model and render immersive real-time "
    "voxel-based clouds";

constexpr Choice distance_content_choices[] = {
    {DistanceContent::distance, "distance",
     "metres to the cloud, negative within it; it must be the first"},
    {DistanceContent::profile, "profile",
     "how deep within the cloud: 0 at its surface, 1 at the depth `core` and deeper"},
    {DistanceContent::detail_type, "detail_type",
     "0 at the base, where details are wisps, 1 from `wisp_height` on, where they are billows"},
    {DistanceContent::density_scale, "density_scale", "mean of the volume's voxels"},
};

const Row<CloudDistanceBake> distance_table[] = {
    {source_volume_field, &CloudDistanceBake::of},
    {source_channel_field, &CloudDistanceBake::channel},
    {"cell", Kind::power_of_two, &CloudDistanceBake::cell, "voxels along each edge of a texel",
     cell_range, Default{"4"}, Hint{"1, 2, 4, 8 or 16"}},
    {"range", Kind::length_bounds, &CloudDistanceBake::range,
     "least and greatest distance, which unorm types store as 0 and 1; distances beyond it are "
     "stored as its ends",
     Range{-1e9, 1e9}, Default{R"(["-256 m", "4096 m"])"},
     Hint{"a texel holds 0 exactly where the ends are as -1 to 16"}, Cited{schneider_2023}},
    {"core", Kind::length, &CloudDistanceBake::core,
     "depth from which the profile is 1; by default the greatest depth of the volume",
     Range{1e-3, 1e9}},
    {"contents", Kind::choice_list, &CloudDistanceBake::contents,
     "what the one, three or four channels hold, in this order", distance_content_choices,
     Default{R"(["distance"])"}, Cited{schneider_2023}},
};

// Returns the number of channels, or 1 if it cannot be told.
std::size_t check_distance_contents(const DecodedSection& bake, Decoder& decoder) {
    const auto* contents = bake.value<std::vector<ChoiceIndex>>("contents");
    if (!contents) return 1;
    if (contents->size() == 2) {
        decoder.report("E0129", bake, "contents", "has two channels",
                       "a picture has one, three or four channels: add one, or bake two assets");
    } else if (!distance_content_choices[contents->front().index].is(DistanceContent::distance)) {
        decoder.report("E0175", bake, "contents", "does not begin with \"distance\"",
                       "lookups find the distance in the first channel");
    }
    return contents->size();
}

// A surface has the distance 0.
void check_distance_range(const DecodedSection& bake, Decoder& decoder) {
    const auto* ends = bake.value<std::array<double, 2>>("range");
    if (!ends || ((*ends)[0] <= 0 && (*ends)[1] > 0)) return;
    decoder.report("E0175", bake, "range", "has no room for the distance 0",
                   "begin it at or below 0 m, and end it above 0 m");
}

// The mean of distances is no distance to keep to.
void check_single_level(const DecodedSection& bake, Decoder& decoder) {
    if (bake.whole("mips").value_or(1) == 1 || !bake.gives("mips")) return;
    decoder.report("E0110", bake, "mips", "must be 1",
                   "bake another cloud_distance with a larger `cell`");
}

// Reports two contents (E0129), other contents than the distance in the first channel and a range
// without 0 (E0175), texels that do not tile as the volume does (E0150), levels (E0110), and what
// find_cells and resolve_cells report.
void resolve_distance(DecodedSection& bake, const RecipeSoFar& recipe, Decoder& decoder) {
    const std::size_t channels = check_distance_contents(bake, decoder);
    check_distance_range(bake, decoder);
    const auto cells =
        find_cells(bake, recipe, "cloud_distance, whose distances must not grow", decoder);
    if (!cells) return;
    resolve_cells(bake, *cells, channels, recipe, decoder);
    check_single_level(bake, decoder);
    check_tiling(bake, *cells, false, decoder);
}

}  // namespace

AssetKind asset_kind(Tag<CloudDistanceBake>) {
    return make_asset_kind<CloudDistanceBake>(
        {.name = "cloud_distance",
         .documentation = "how far it is to a cloud volume's cloud, for rays traced in spheres",
         .of_another_bake = true},
        with_file_fields(distance_table,
                         {.formats = R"(["bin"])", .mips = "number of levels, which is 1"}),
        reads_of_its_source, resolve_distance);
}

}  // namespace skybake::config
