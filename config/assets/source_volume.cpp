#include "config/assets/source_volume.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <span>

#include "config/sections/file_formats.h"
#include "config/sections/frames.h"
#include "config/sections/noise.h"
#include "config/sections/parameters.h"
#include "config/text/key_path.h"
#include "config/text/text.h"

namespace skybake::config {
namespace {

template <class T>
const T* find_by_name(std::span<const T> things, std::string_view name) {
    const auto found = std::ranges::find(things, name, &T::name);
    return found == things.end() ? nullptr : &*found;
}

std::vector<std::string_view> volume_names(const RecipeSoFar& recipe) {
    std::vector<std::string_view> names;
    for (const Bake& other : recipe.bakes) {
        if (other.is<CloudVolumeBake>()) names.push_back(other.name);
    }
    return names;
}

// Returns "v_0001 to v_0012" of a sequence of volumes, or nothing if there is none of that name.
std::string frames_of_sequence(std::span<const std::string_view> names, const std::string& name) {
    std::vector<std::string_view> frames;
    for (const std::string_view other : names) {
        const std::string whole(other);
        if (sequence_name(whole) == name && whole != name) frames.push_back(other);
    }
    const int count = static_cast<int>(frames.size());
    if (count == 0 || frames.front() != frame_name(name, 1, count)) return "";
    return fmt::format("{} to {}", frames.front(), frames.back());
}

void report_no_volume(const DecodedSection& bake, std::string_view key, const RecipeSoFar& recipe,
                      const std::string& name, bool is_other_asset, Decoder& decoder) {
    const std::vector<std::string_view> names = volume_names(recipe);
    if (const std::string frames = frames_of_sequence(names, name); !frames.empty()) {
        decoder.report(
            "E0133", bake, key,
            fmt::format("must name one frame of [bake.{}], which has several", shorten(name)),
            fmt::format("this recipe has {}", frames));
        return;
    }
    std::string label = did_you_mean(name, names);
    if (label.empty() && names.empty()) {
        label = "the recipe has no [bake.NAME] with asset = \"cloud_volume\"";
    }
    if (label.empty()) label = fmt::format("this recipe has {}", fmt::join(names, ", "));
    decoder.report(
        "E0133", bake, key,
        is_other_asset
            ? fmt::format("must name a cloud_volume, and [bake.{}] is another asset", shorten(name))
            : fmt::format(": the recipe has no [bake.{}]", shorten(name)),
        std::move(label));
}

// Returns the channels of the volume, or an empty list if its cloud or noise is at fault.
std::vector<std::string> channels_of(const CloudVolumeBake& volume, const RecipeSoFar& recipe) {
    const Cloud* cloud = find_cloud(volume, recipe);
    const Noise* noise =
        cloud ? find_by_name<Noise>(recipe.parameters.noises, cloud->noise) : nullptr;
    const bool is_known =
        cloud && (noise || !cloud->volume.empty() || cloud->shape == CloudShape::convection);
    if (!is_known) return {};
    return cloud_channel_names(noise, cloud->channels);
}

}  // namespace

const CloudVolumeBake* find_source_volume(const DecodedSection& bake, const RecipeSoFar& recipe,
                                          Decoder& decoder) {
    const auto* name = bake.value<std::string>("of");
    return name ? find_volume_named(bake, "of", *name, recipe, decoder) : nullptr;
}

const CloudVolumeBake* find_volume_named(const DecodedSection& bake, std::string_view key,
                                         const std::string& name, const RecipeSoFar& recipe,
                                         Decoder& decoder) {
    const Bake* found = find_by_name(recipe.bakes, name);
    const auto* volume = found ? found->find<CloudVolumeBake>() : nullptr;
    const auto& unreadable = recipe.unreadable;
    const bool is_reported = std::ranges::find(unreadable, name) != unreadable.end();
    if (!volume && !is_reported && decoder.complete) {
        report_no_volume(bake, key, recipe, name, found != nullptr, decoder);
    }
    return volume;
}

void check_source_channel(const DecodedSection& bake, const CloudVolumeBake& volume,
                          const RecipeSoFar& recipe, Decoder& decoder) {
    const auto* name = bake.value<std::string>("channel");
    const std::vector<std::string> channels = channels_of(volume, recipe);
    if (!name || name->empty() || channels.empty()) return;
    if (std::ranges::find(channels, *name) != channels.end()) return;
    decoder.report(
        "E0134", bake, "channel",
        fmt::format(": `{}` has no channel `{}`", *bake.value<std::string>("of"), shorten(*name)),
        fmt::format("channel{} {}", channels.size() == 1 ? " is" : "s are",
                    fmt::join(channels, ", ")));
}

VoxelCounts cells_of(const CloudVolumeBake& volume, int edge) {
    VoxelCounts cells{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        cells[axis] = (volume.size[axis] + edge - 1) / edge;
    }
    return cells;
}

std::optional<VolumeCells> find_cells(const DecodedSection& bake, const RecipeSoFar& recipe,
                                      const std::string& refused, Decoder& decoder) {
    check_pixel_type(bake, decoder);
    refuse_blocks(bake, refused, decoder);
    const CloudVolumeBake* volume = find_source_volume(bake, recipe, decoder);
    if (!volume) return std::nullopt;
    check_source_channel(bake, *volume, recipe, decoder);
    const std::optional<int> edge = bake.whole("cell");
    if (!edge || volume->size[0] == 0) return std::nullopt;
    return VolumeCells{*volume, *edge, cells_of(*volume, *edge)};
}

void resolve_cells(DecodedSection& bake, const VolumeCells& cells, std::size_t channels,
                   const RecipeSoFar& recipe, Decoder& decoder) {
    const Place& of = bake.place_of("of");
    resolve_files(bake, cells.counts, Halving::up, decoder);
    check_voxel_count(bake, cells.counts, channels, of, decoder);
    const Cloud* cloud = find_cloud(cells.volume, recipe);
    if (!cloud || cloud->extent[0].meters <= 0) return;
    std::array<double, 3> edges = voxel_edges(*cloud, cells.volume);
    for (double& edge : edges) edge *= cells.edge;
    check_cubes(bake, edges, of, decoder);
}

void check_tiling(const DecodedSection& bake, const VolumeCells& cells, bool one_may_hold_all,
                  Decoder& decoder) {
    for (std::size_t axis = 0; axis < 2; ++axis) {
        const int voxels = cells.volume.size[axis];
        if (voxels % cells.edge == 0 || (one_may_hold_all && voxels < cells.edge)) continue;
        const std::string of = shorten(*bake.value<std::string>("of"));
        return decoder.diagnostics.error(
            "E0150", bake.place_of("cell", "of"),
            fmt::format("cells of {} voxels do not tile the {} voxel{} of `{}` along {}",
                        cells.edge, voxels, voxels == 1 ? "" : "s", of, "xy"[axis]),
            fmt::format("give `{}` a size that {} divides, or a `cell` that divides the size", of,
                        cells.edge));
    }
}

const Cloud* find_cloud(const CloudVolumeBake& volume, const RecipeSoFar& recipe) {
    return find_by_name<Cloud>(recipe.parameters.clouds, volume.cloud);
}

std::vector<Read> reads_of_source_volume(const Parameters& parameters, const std::string& of) {
    const auto& volume = bake_named(parameters, of).as<CloudVolumeBake>();
    std::vector<Read> reads = reads_of_cloud(parameters, volume.cloud);
    const bool has_usual_files = facts_of(FileFormat::vdb).holds(volume.pixel_type);
    reads.push_back({join_path("bake", of),
                     has_usual_files ? Roles{Role::content} : Roles{Role::content, Role::files}});
    return reads;
}

}  // namespace skybake::config
