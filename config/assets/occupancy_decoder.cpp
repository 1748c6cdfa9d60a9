#include "config/assets/occupancy_decoder.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "config/assets/volume_files_decoder.h"
#include "config/fields/named_reference.h"
#include "config/sections/cloud_channels.h"
#include "config/sections/cloud_extent.h"
#include "config/text/key_path.h"
#include "config/text/suggest.h"

namespace skybake::config {
namespace {

template <class T>
const T* find_by_name(std::span<const T> things, std::string_view name) {
    const auto found = std::find_if(things.begin(), things.end(),
                                    [&](const T& thing) { return thing.name == name; });
    return found == things.end() ? nullptr : &*found;
}

// One section while it is resolved.
struct OccupancyResolver {
    DecodedSection& bake;
    const OccupancySources& sources;
    Decoder& decoder;

    std::vector<std::string_view> volume_names() const {
        std::vector<std::string_view> names;
        for (const Bake& other : sources.bakes) {
            if (std::holds_alternative<CloudVolumeBake>(other.asset)) names.push_back(other.name);
        }
        return names;
    }

    void report_no_volume(const std::string& name, bool is_other_asset) const {
        const std::vector<std::string_view> names = volume_names();
        std::string label = did_you_mean(name, names);
        if (label.empty() && names.empty()) {
            label = "the recipe has no [bake.NAME] with asset = \"cloud_volume\"";
        }
        if (label.empty()) label = fmt::format("this recipe has {}", fmt::join(names, ", "));
        decoder.diagnostics.error(
            "E0133", bake.at("of").source->place,
            is_other_asset
                ? fmt::format("`{}` must name a cloud_volume, and [bake.{}] is another asset",
                              join_path(bake.path, "of"), shorten(name))
                : fmt::format("`{}`: the recipe has no [bake.{}]", join_path(bake.path, "of"),
                              shorten(name)),
            std::move(label));
    }

    const CloudVolumeBake* find_volume() const {
        const std::string* name = text_of(bake.at("of"));
        if (!name) return nullptr;
        const Bake* found = find_by_name(sources.bakes, *name);
        const auto* volume = found ? std::get_if<CloudVolumeBake>(&found->asset) : nullptr;
        const auto& unreadable = sources.unreadable;
        const bool is_reported =
            std::find(unreadable.begin(), unreadable.end(), *name) != unreadable.end();
        if (!volume && !is_reported && decoder.complete) report_no_volume(*name, found != nullptr);
        return volume;
    }

    // Empty if the volume's cloud or noise is at fault.
    std::vector<std::string> channels_of(const CloudVolumeBake& volume) const {
        const Cloud* cloud = find_by_name(sources.clouds, volume.cloud);
        const Noise* noise = cloud ? find_by_name(sources.noises, cloud->noise) : nullptr;
        if (!noise) return {};
        return cloud_channel_names(*noise, cloud->channels);
    }

    void check_channel(const CloudVolumeBake& volume) const {
        const DecodedField& decoded = bake.at("channel");
        const std::string* name = text_of(decoded);
        const std::vector<std::string> channels = channels_of(volume);
        if (!name || name->empty() || channels.empty()) return;
        if (std::find(channels.begin(), channels.end(), *name) != channels.end()) return;
        decoder.diagnostics.error(
            "E0134", decoded.source->place,
            fmt::format("`{}`: `{}` has no channel `{}`", join_path(bake.path, "channel"),
                        *text_of(bake.at("of")), shorten(*name)),
            fmt::format("channel{} {}", channels.size() == 1 ? " is" : "s are",
                        fmt::join(channels, ", ")));
    }

    std::size_t check_contents() const {
        const DecodedField& decoded = bake.at("contents");
        if (!decoded.value) return 1;
        const std::size_t count = std::get<std::vector<ChoiceIndex>>(*decoded.value).size();
        if (count != 2) return count;
        decoder.diagnostics.error(
            "E0129", decoded.source->place,
            fmt::format("`{}` has two channels", join_path(bake.path, "contents")),
            "a picture has one, three or four channels: add one, or bake them as two assets");
        return count;
    }

    void report_untiled(const CloudVolumeBake& volume, int cell, std::size_t axis) const {
        const DecodedField& said = bake.at("cell");
        decoder.diagnostics.error(
            "E0150", said.source ? said.source->place : bake.at("of").source->place,
            fmt::format("cells of {} voxels do not tile the {} voxels of `{}` along {}", cell,
                        volume.size[axis], shorten(*text_of(bake.at("of"))), "xy"[axis]),
            fmt::format("give `{}` a size that {} divides, or a `cell` that divides the size",
                        shorten(*text_of(bake.at("of"))), cell));
    }

    // The volume repeats along x and y. A cell that sticks out of the tile would repeat with
    // another period than the volume: a runtime that repeats both would find other cells than those
    // that its voxels lie in. One cell that holds the whole tile is the same everywhere.
    void check_tiling(const CloudVolumeBake& volume, int cell) const {
        for (std::size_t axis = 0; axis < 2; ++axis) {
            const bool tiles = volume.size[axis] % cell == 0 || volume.size[axis] < cell;
            if (!tiles) return report_untiled(volume, cell, axis);
        }
    }

    // A level of half an odd number of cells, rounded up, spans more than the level before, and one
    // texture coordinate does not serve both.
    void check_halving(const VoxelCounts& cells) const {
        const DecodedField& mips = bake.at("mips");
        if (!mips.value) return;
        const int halvings = static_cast<int>(std::get<double>(*mips.value)) - 1;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            int left = cells[axis];
            int done = 0;
            for (; done < halvings && left % 2 == 0; ++done) left /= 2;
            if (done >= halvings || left == 1) continue;
            decoder.diagnostics.error(
                "E0150", mips.source->place,
                fmt::format("the {} cells of [{}] along {} cannot be halved {} time{}", cells[axis],
                            bake.path, "xyz"[axis], halvings, halvings == 1 ? "" : "s"),
                fmt::format("use at most {} levels, or another size", done + 1));
            return;
        }
    }

    void check_voxels(const CloudVolumeBake& volume, int cell) const {
        const Cloud* cloud = find_by_name(sources.clouds, volume.cloud);
        if (!cloud || cloud->extent[0].meters <= 0) return;
        std::array<double, 3> edges = voxel_edges(*cloud, volume);
        for (double& edge : edges) edge *= cell;
        check_cubes(bake, edges, bake.at("of").source->place, decoder);
    }

    // Cells along each axis, those that stick out above among them.
    VoxelCounts cells_of(const CloudVolumeBake& volume, int cell) const {
        VoxelCounts cells{};
        for (std::size_t axis = 0; axis < 3; ++axis) {
            cells[axis] = (volume.size[axis] + cell - 1) / cell;
        }
        return cells;
    }
};

}  // namespace

void resolve_occupancy(DecodedSection& bake, const OccupancySources& sources, Decoder& decoder) {
    const OccupancyResolver resolver{bake, sources, decoder};
    check_pixel_type(bake, decoder);
    const std::size_t contents = resolver.check_contents();
    const CloudVolumeBake* volume = resolver.find_volume();
    if (!volume) return;
    resolver.check_channel(*volume);
    const DecodedField& cell = bake.at("cell");
    if (!cell.value || volume->size[0] == 0) return;
    const int edge = static_cast<int>(std::get<double>(*cell.value));
    const VoxelCounts cells = resolver.cells_of(*volume, edge);
    resolve_volume_files(bake, cells, Halving::up, decoder);
    resolver.check_tiling(*volume, edge);
    resolver.check_halving(cells);
    resolver.check_voxels(*volume, edge);
    check_voxel_count(bake, cells, contents, bake.at("of").source->place, decoder);
}

}  // namespace skybake::config
