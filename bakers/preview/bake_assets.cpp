#include "bakers/preview/bake_assets.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <limits>
#include <utility>

#include "bakers/assets/registry/registry.h"
#include "bakers/field/baked.h"
#include "bakers/field/pixel_type.h"
#include "bakers/io/formats/format.h"
#include "bakers/io/manifest/asset_files.h"
#include "bakers/io/manifest/metadata.h"
#include "bakers/math/bake_clock.h"
#include "bakers/math/parallel.h"
#include "bakers/preview/check_options.h"
#include "bakers/preview/load_assets.h"
#include "bakers/workspace/folder_plan.h"

namespace skybake {
namespace {

std::array<int, 3> shown_size(const std::array<int, 3>& size, int edge) {
    std::array<int, 3> cubes = size;
    for (int& extent : cubes) extent = (extent + edge - 1) / edge;
    return cubes;
}

// Each extent is at most 65536 (see manifest_reader.cpp), so the product fits into 64 bits.
std::size_t count_of(const std::array<int, 3>& size, std::size_t channels) {
    return static_cast<std::size_t>(VoxelBox{{}, size}.count()) * channels;
}

// Returns the voxels of a level as stored, channels interleaved.
std::vector<float> stored_voxels(const Baked& volume, const ShownLevel& shown,
                                 const BakeOptions& options) {
    const std::size_t channels = volume.channel_names.size();
    ShownTexels texels(volume.levels[shown.level].size, channels, shown.edge);
    const auto width = bytes_per_value(volume.pixel_type);
    std::vector<float> values;
    std::int64_t done = 0;
    write_texels({volume, 0, "", options.threads, options.progress}, static_cast<int>(shown.level),
                 [&](std::string_view bytes) {
                     values.resize(bytes.size() / width);
                     load_values(bytes.data(), values.size(), volume.pixel_type, values.data());
                     const auto count = static_cast<std::int64_t>(values.size() / channels);
                     texels.add(done, count, values.data());
                     done += count;
                     return true;
                 });
    return std::move(texels.values);
}

PreviewAsset volume_asset(const Baked& volume, const Timing& timing, const BakeOptions& options,
                          std::vector<std::string>& notes) {
    ManifestAsset entry = describe(volume);
    entry.timing = timing;
    const ShownLevel shown = shown_level(entry);
    if (!shown.is_whole()) notes.push_back(level_note(entry, shown));
    return {at_level(entry, shown), {}, stored_voxels(volume, shown, options)};
}

PreviewAsset table_asset(const Baked& table, const Timing& timing) {
    ManifestAsset entry = describe(table);
    entry.timing = timing;
    return {std::move(entry), table.image(), {}};
}

class PreviewBake {
  public:
    PreviewBake(const Recipe& recipe, const BakeOptions& options, AssetMemo* memory,
                const BakeStages& stages)
        : recipe_(recipe),
          options_(options),
          memory_(memory != nullptr ? *memory : own_memory_),
          stages_(stages),
          own_intermediates_(options.held_voxel_bytes) {
        if (options_.intermediates == nullptr) options_.intermediates = &own_intermediates_;
    }

    Outcome<PreviewAssets> bake(std::span<const Bake> bakes, const std::string& title) {
        shown_.title = title;
        shown_.recipe = recipe_;
        diagnostics_ = unused_keys(recipe_);
        memory_.ready.clear();
        const auto expected = options_.intermediates->expect(
            needs_of(recipe_.parameters, bakes, options_.certification));
        for (const Bake& bake : bakes) {
            if (stages_.progress != nullptr) {
                stages_.progress->begin_stage(++stage_, stages_.count, bake.name);
            }
            const bool made = add(bake);
            if (options_.cancelled()) return interrupted();
            if (!made) return {{}, std::move(diagnostics_)};
        }
        remember();
        return {std::move(shown_), std::move(diagnostics_)};
    }

  private:
    // Keeps the finished assets for the next bake.
    Outcome<PreviewAssets> interrupted() {
        memory_.unfinished = std::move(fresh_memory_);
        return {};
    }

    void remember() {
        if (memory_.keeps_all) fresh_memory_.merge(memory_.assets);
        memory_.assets = std::move(fresh_memory_);
        memory_.unfinished.clear();
    }

    bool add(const Bake& bake) {
        const AssetIdentity identity = identity_of(bake, options_.certification);
        const std::string& key = identity.key;
        if (const PreviewAsset* known = remembered(key)) {
            shown_.assets.push_back(*known);
        } else if (!add_ready_made(bake) && !add_baked(bake, identity)) {
            return false;
        }
        if (!key.empty()) fresh_memory_[key] = shown_.assets.back();
        return true;
    }

    // Returns the identity of an asset. Its key is empty if an input cannot be read; the bake reports
    // that.
    AssetIdentity identity_of(const Bake& bake, Certification certification) const {
        auto identity = asset_identity(recipe_, bake, certification);
        return identity.value ? std::move(*identity.value) : AssetIdentity();
    }

    // Adds an asset from files that were baked before. Returns false if there are none.
    bool add_ready_made(const Bake& bake) {
        if (memory_.sources.empty()) return false;
        for (const Certification certification :
             {Certification::full, Certification::quick, Certification::off}) {
            if (certification == Certification::off && options_.certification != certification)
                continue;
            const std::string key = identity_of(bake, certification).key;
            for (AssetSource* source : memory_.sources) {
                const auto ready = source->find(key);
                if (!ready) continue;
                if (add_ready(*ready, bake.name, shown_)) {
                    memory_.ready.push_back(bake.name);
                    return true;
                }
                source->reject(*ready);
            }
        }
        return false;
    }

    const PreviewAsset* remembered(const std::string& key) const {
        if (key.empty()) return nullptr;
        for (const auto* assets : {&memory_.assets, &memory_.unfinished}) {
            if (const auto known = assets->find(key); known != assets->end()) return &known->second;
        }
        return nullptr;
    }

    bool add_baked(const Bake& bake, const AssetIdentity& identity) {
        BakeClock clock;
        Outcome<Baked> baked = bake_asset(recipe_, bake, options_);
        const Timing timing = {clock.seconds(), 0, thread_count(options_.threads)};
        std::ranges::move(baked.diagnostics, std::back_inserter(diagnostics_));
        if (!baked.value) return false;
        shown_.assets.push_back(baked.value->is_table()
                                    ? table_asset(*baked.value, timing)
                                    : volume_asset(*baked.value, timing, options_, shown_.notes));
        if (memory_.cache != nullptr && baked.value->is_table() && !options_.cancelled()) {
            ManifestAsset entry = describe_with_files(*baked.value);
            entry.timing = timing;
            sign(identity, entry);
            memory_.cache->offer(*baked.value, std::move(entry), options_.threads);
        }
        return true;
    }

    const Recipe& recipe_;
    BakeOptions options_;
    AssetMemo own_memory_;
    AssetMemo& memory_;
    const BakeStages& stages_;
    Intermediates own_intermediates_;
    int stage_ = 0;
    std::map<std::string, PreviewAsset> fresh_memory_;
    PreviewAssets shown_;
    std::vector<Diagnostic> diagnostics_;
};

}  // namespace

Outcome<PreviewAssets> bake_assets(const Recipe& recipe, std::span<const Bake> bakes,
                                   const std::string& title, const BakeOptions& options,
                                   AssetMemo* memory, const BakeStages& stages) {
    return PreviewBake(recipe, options, memory, stages).bake(bakes, title);
}

const PreviewAsset* PreviewAssets::of_kind(std::string_view kind) const {
    const auto sky_error = [](const PreviewAsset& asset) {
        const auto& error = asset.entry.error;
        return error && error->sky ? error->sky->median : std::numeric_limits<double>::infinity();
    };
    const PreviewAsset* best = nullptr;
    for (const PreviewAsset& asset : assets) {
        if (asset.entry.kind != kind) continue;
        if (best == nullptr || sky_error(asset) < sky_error(*best)) best = &asset;
    }
    return best;
}

ShownLevel shown_level(const ManifestAsset& asset) {
    ShownLevel shown;
    const auto fits = [&] {
        const auto size = shown_size(asset.levels[shown.level].size, shown.edge);
        return count_of(size, asset.channels.size()) <= most_previewed_values;
    };
    while (!fits() && shown.level + 1 < asset.levels.size()) ++shown.level;
    while (!fits()) shown.edge *= 2;
    return shown;
}

ManifestAsset at_level(const ManifestAsset& asset, const ShownLevel& shown) {
    if (shown.is_whole()) return asset;
    ManifestAsset reduced = asset;
    reduced.levels = {asset.levels[shown.level]};
    const std::array<int, 3> size = shown_size(reduced.levels[0].size, shown.edge);
    reduced.levels[0].size = size;
    reduced.size.assign(size.begin(), size.begin() + static_cast<long>(asset.axes.size()));
    reduced.content_hash = reduced.levels[0].content_hash;
    return reduced;
}

std::string level_note(const ManifestAsset& asset, const ShownLevel& shown) {
    const std::string what =
        shown.edge == 1 ? fmt::format("level {}", shown.level)
                        : fmt::format("means over cubes of {} voxels along an edge", shown.edge);
    return fmt::format("{}: {} voxels are more than a preview holds; it shows {}", asset.name,
                       fmt::join(asset.size, " x "), what);
}

ShownTexels::ShownTexels(const std::array<int, 3>& size, std::size_t channels, int edge)
    : values(count_of(shown_size(size, edge), channels)),
      size_(size),
      channels_(channels),
      edge_(edge) {}

void ShownTexels::add(std::int64_t first, std::int64_t count, const float* texels) {
    if (edge_ == 1) {
        std::copy_n(texels, static_cast<std::size_t>(count) * channels_,
                    &values[static_cast<std::size_t>(first) * channels_]);
        return;
    }
    const std::array<int, 3> cubes = shown_size(size_, edge_);
    for (const std::int64_t end = first + count; first < end; ++first) {
        std::int64_t above = first, cube = 0, cubes_below = 1;
        int texels_of_cube = 1;  // fewer where it ends with the level
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const auto place = static_cast<int>(above % size_[axis]) / edge_;
            above /= size_[axis];
            cube += place * cubes_below;
            cubes_below *= cubes[axis];
            texels_of_cube *= std::min(edge_, size_[axis] - place * edge_);
        }
        float* const sum = &values[static_cast<std::size_t>(cube) * channels_];
        for (std::size_t c = 0; c < channels_; ++c) {
            sum[c] += *texels++ / static_cast<float>(texels_of_cube);
        }
    }
}

}  // namespace skybake
