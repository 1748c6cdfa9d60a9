#include "bakers/preview/bake_assets.h"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "bakers/core/parallel.h"
#include "bakers/core/pixel_type.h"
#include "bakers/core/tiles.h"
#include "bakers/io/metadata.h"
#include "bakers/registry.h"

namespace skybake {
namespace {

using config::Outcome;

// The voxels of a level as stored, channels interleaved.
std::vector<float> stored_voxels(const BakedVolume& volume, const VolumeLevel& level,
                                 const BakeOptions& options) {
    const auto slice =
        static_cast<std::size_t>(level.size[0]) * static_cast<std::size_t>(level.size[1]);
    const std::size_t channels = volume.channel_names.size();
    std::vector<float> voxels(slice * static_cast<std::size_t>(level.size[2]) * channels);
    constexpr int depth = 8;
    for_each_tile((level.size[2] + depth - 1) / depth, options, "voxels", [&](int tile) {
        const int z = tile * depth;
        const int planes = std::min(depth, level.size[2] - z);
        const std::size_t count = slice * static_cast<std::size_t>(planes);
        std::vector<float> made(count * channels);
        std::vector<float*> targets;
        for (std::size_t c = 0; c < channels; ++c) targets.push_back(made.data() + c * count);
        level.voxels->fill({{0, 0, z}, {level.size[0], level.size[1], planes}}, targets);
        float* out = voxels.data() + static_cast<std::size_t>(z) * slice * channels;
        for (std::size_t i = 0; i < count; ++i) {
            for (std::size_t c = 0; c < channels; ++c) {
                *out++ = round_to_pixel_type(made[c * count + i], volume.pixel_type);
            }
        }
    });
    return voxels;
}

void add_volume(BakedVolume volume, const BakeOptions& options, PreviewAssets& shown) {
    ManifestAsset entry = describe(volume);
    entry.timing = {volume.bake_seconds, 0, thread_count(options.threads)};
    const std::optional<std::size_t> level = previewed_level(entry);
    if (level != std::size_t{0}) shown.notes.push_back(level_note(entry, level));
    PreviewAsset asset;
    asset.entry = level ? at_level(entry, *level) : std::move(entry);
    if (level) asset.voxels = stored_voxels(volume, volume.levels[*level], options);
    shown.assets.push_back(std::move(asset));
}

void add_table(BakedTable table, const BakeOptions& options, PreviewAssets& shown) {
    ManifestAsset entry = describe(table);
    entry.timing = {table.bake_seconds, 0, thread_count(options.threads)};
    shown.assets.push_back({std::move(entry), std::move(table.image), {}});
}

}  // namespace

Outcome<PreviewAssets> bake_assets(const config::Recipe& recipe,
                                   std::span<const config::Bake> bakes, const std::string& title,
                                   const BakeOptions& options) {
    Outcome<PreviewAssets> outcome;
    PreviewAssets shown;
    shown.title = title;
    shown.parameters = recipe.parameters;
    for (const config::Bake& bake : bakes) {
        Outcome<BakedAsset> baked = bake_asset(recipe, bake, options);
        std::move(baked.diagnostics.begin(), baked.diagnostics.end(),
                  std::back_inserter(outcome.diagnostics));
        if (options.progress != nullptr && options.progress->cancelled()) return {};
        if (!baked.value) return outcome;
        if (auto* volume = std::get_if<BakedVolume>(&*baked.value)) {
            add_volume(std::move(*volume), options, shown);
        } else {
            add_table(std::get<BakedTable>(std::move(*baked.value)), options, shown);
        }
        if (options.progress != nullptr && options.progress->cancelled()) return {};
    }
    outcome.value = std::move(shown);
    return outcome;
}

}  // namespace skybake
