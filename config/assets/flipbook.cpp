#include "config/assets/flipbook.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <span>
#include <string_view>
#include <vector>

#include "config/assets/asset_fields.h"
#include "config/assets/asset_kind.h"
#include "config/assets/cloud_volume.h"
#include "config/assets/file_decoder.h"
#include "config/assets/noise_volume.h"
#include "config/assets/weather_map.h"
#include "config/fields/fields.h"
#include "config/fields/section_decoder.h"
#include "config/sections/frames.h"
#include "config/sections/noise.h"
#include "config/text/key_path.h"

namespace skybake::config {
namespace {

constexpr Choice mapping_choices[] = {
    {FlipbookMapping::frames, "frames",
     "a 3-D texture with a slice for each frame, which has one level"},
    {FlipbookMapping::layers, "layers",
     "an array of 2-D textures with a layer for each frame, which may have `mips`"},
};

const Row<FlipbookBake> flipbook_table[] = {
    {"of", Kind::text, &FlipbookBake::sequence,
     "NAME of the [bake.NAME] with `frames`: a noise_volume, a weather_map or a cloud_volume",
     KeyFlag::required},
    {"length", Kind::integer, &FlipbookBake::length,
     "number of frames; by default those of the sequence", Range{1, 16384},
     Hint{"columns times rows of a sheet"}},
    {"slice", Kind::integer, &FlipbookBake::slice,
     "which slice of volumes, counted from 0 along z; by default the middle one", Range{0, 16383}},
    {"mapping", Kind::choice, &FlipbookBake::mapping, "what DDS and KTX2 files hold the frames as",
     mapping_choices, Default{R"("frames")"}},
};

template <class Frame>
bool is_first(const Bake& bake) {
    const Frame* frame = bake.find<Frame>();
    return frame != nullptr && frame->frame == 1;
}

bool is_first_frame(const Bake& bake) {
    return is_first<NoiseVolumeBake>(bake) || is_first<WeatherMapBake>(bake) ||
           is_first<CloudVolumeBake>(bake);
}

const Bake* find_first(std::span<const Bake> bakes, std::string_view sequence) {
    const auto found = std::ranges::find_if(bakes, [&](const Bake& bake) {
        return is_first_frame(bake) && sequence_name(bake.name) == sequence;
    });
    return found == bakes.end() ? nullptr : &*found;
}

int length_of(std::span<const Bake> bakes, const std::string& sequence) {
    return static_cast<int>(std::ranges::count_if(bakes, [&](const Bake& bake) {
        const bool may_be_frame =
            bake.is<NoiseVolumeBake>() || bake.is<WeatherMapBake>() || bake.is<CloudVolumeBake>();
        return may_be_frame && sequence_name(bake.name) == sequence && bake.name != sequence;
    }));
}

void report_no_sequence(const DecodedSection& bake, const RecipeSoFar& recipe,
                        const std::string& name, Decoder& decoder) {
    std::vector<std::string> names;
    for (const Bake& other : recipe.bakes) {
        if (is_first_frame(other)) names.push_back(sequence_name(other.name));
    }
    decoder.report("E0133", bake, "of",
                   fmt::format(": the recipe has no [bake.{}] with `frames`", shorten(name)),
                   names.empty() ? "the recipe has no bake of several frames"
                                 : fmt::format("this recipe has {}", fmt::join(names, ", ")));
}

std::size_t channels_of(const Bake& frame, const Parameters& recipe) {
    if (const auto* cloud = frame.find<CloudVolumeBake>()) {
        const Cloud& made = cloud_named(recipe, cloud->cloud);
        return cloud_channel_names(noise_of(recipe, made), made.channels).size();
    }
    const auto* map = frame.find<WeatherMapBake>();
    const Noise& noise = noise_named(recipe, map ? map->noise : frame.as<NoiseVolumeBake>().noise);
    return noise.pack == NoisePacking::none ? noise.channels.size() : 1;
}

// Reports levels of a 3-D texture, which would mix frames (E0110). All sheets of levels get the columns of
// the first one.
void resolve_levels(DecodedSection& bake, const VoxelCounts& size, Decoder& decoder) {
    if (bake.whole("mips").value_or(0) < 2) return;
    if (choice_of<FlipbookMapping>(bake.at("mapping")) != FlipbookMapping::layers) {
        decoder.report("E0110", bake, "mips", ": levels of a 3-D texture would mix frames",
                       "`mapping = \"layers\"` has levels that keep frames apart");
    }
    if (choice_of<SheetLayout>(bake.at("layout")) != SheetLayout::atlas) return;
    derive(bake.at("columns"), double{1} * slice_sheet(size, SheetLayout::atlas, 0).columns);
}

// Fills in `length` and `slice`. It reports a name that is no sequence's (E0133), a slice that the volume
// does not have (E0110), and faults of the levels and of the files of any volume (file_decoder.h).
void resolve_flipbook(DecodedSection& bake, const RecipeSoFar& recipe, Decoder& decoder) {
    check_pixel_type(bake, decoder);
    const auto* name = bake.value<std::string>("of");
    if (!name) return;
    const Bake* first = find_first(recipe.bakes, *name);
    const auto& unreadable = recipe.unreadable;
    const bool is_reported = std::ranges::find(unreadable, *name) != unreadable.end();
    if (!first) {
        if (!is_reported && decoder.complete) report_no_sequence(bake, recipe, *name, decoder);
        return;
    }
    const auto [width, height, depth] = frame_size(*first);
    derive(bake.at("length"), double{1} * length_of(recipe.bakes, *name));
    derive(bake.at("slice"), double{1} * (depth / 2));
    if (bake.whole("slice").value_or(0) >= depth && depth > 0) {
        decoder.report("E0110", bake, "slice",
                       fmt::format("is {}", bake.whole("slice").value_or(0)),
                       fmt::format("the frames have slices 0 to {}", depth - 1));
    }
    const VoxelCounts size = {width, height, bake.whole("length").value_or(0)};
    if (width < 1 || size[2] < 1) return;
    resolve_files(bake, size, Halving::down_within_slices, decoder);
    resolve_levels(bake, size, decoder);
    const bool is_whole = !decoder.diagnostics.has_errors();
    const std::size_t channels = is_whole ? channels_of(*first, recipe.parameters) : 1;
    check_voxel_count(bake, size, channels, bake.at("of").source->place, decoder);
}

std::vector<Read> reads_of(const Parameters& parameters, const FlipbookBake& bake) {
    const Bake& first = first_frame(parameters, bake);
    std::vector<Read> reads = kind_of(first).reads(parameters, first);
    const bool has_usual_files = facts_of(FileFormat::exr).holds(files_of(first).pixel_type);
    reads.push_back({join_path("bake", first.name),
                     has_usual_files ? Roles{Role::content} : Roles{Role::content, Role::files}});
    return reads;
}

}  // namespace

const Bake& first_frame(const Parameters& parameters, const FlipbookBake& asset) {
    return *find_first(parameters.bakes, asset.sequence);
}

std::array<int, 3> frame_size(const Bake& frame) {
    if (const auto* noise = frame.find<NoiseVolumeBake>()) return noise->size;
    if (const auto* cloud = frame.find<CloudVolumeBake>()) return cloud->size;
    const auto [width, height] = frame.as<WeatherMapBake>().size;
    return {width, height, 1};
}

AssetKind asset_kind(Tag<FlipbookBake>) {
    return make_asset_kind<FlipbookBake>(
        {.name = "flipbook",
         .documentation = "the frames of a sequence in one sheet or texture",
         .of_another_bake = true,
         .of_all_frames = true},
        with_file_fields(flipbook_table, {.formats = R"(["png"])",
                                          .mips = "number of levels of detail of each frame by "
                                                  "itself, which `mapping = \"layers\"` may have",
                                          .pixel_type = R"("unorm8")",
                                          .layout = R"("atlas")"}),
        reads_of, resolve_flipbook);
}

}  // namespace skybake::config
