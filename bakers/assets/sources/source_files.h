// Assets that are made from another asset, as a folder holds them: their files, and what their entries
// of the manifest say. For checks of a whole folder.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bakers/io/formats/format.h"
#include "bakers/io/manifest/asset_files.h"
#include "bakers/io/manifest/manifest.h"
#include "bakers/io/manifest/verify.h"
#include "config/assets/cloud_volume.h"
#include "config/recipe/asset_parameters.h"
#include "config/recipe/recipe.h"
#include "config/sections/parameters.h"

namespace skybake {

// Returns the asset of this name, or null.
inline const ManifestAsset* asset_named(const Manifest& manifest, const std::string& name) {
    const auto found = std::ranges::find(manifest.assets, name, &ManifestAsset::name);
    return found != manifest.assets.end() ? &*found : nullptr;
}

// Returns the first file that holds the volume itself and can be read back, or null.
inline const ManifestFile* first_file(const ManifestAsset& asset) {
    const auto found = std::ranges::find_if(asset.files, [](const ManifestFile& file) {
        const Format* format = find_format(file.format);
        return file.level == 0 && format != nullptr && format->read != nullptr;
    });
    return found != asset.files.end() ? &*found : nullptr;
}

// Passes a channel of a file's finest voxels to use(index, value), one by one. Returns false where it
// cannot be read, which fails elsewhere.
template <class Use>
bool read_channel(const std::filesystem::path& folder, const ManifestAsset& asset,
                  const ManifestFile& file, std::size_t channel, const Use& use) {
    const auto visit = [&](std::int64_t first, std::int64_t count, const float* values) {
        for (std::int64_t i = first; i < first + count; ++i, values += asset.channels.size()) {
            use(i, values[channel]);
        }
        return true;
    };
    return read_asset_file(folder / file.path, asset, file, 0, visit).value.has_value();
}

// Returns the index of a volume's channel of this name, or of its first one where the name is empty.
// Returns none if it has no such channel.
inline std::optional<std::size_t> channel_in(const ManifestAsset& volume, const std::string& name) {
    if (name.empty()) return 0;
    const auto found = std::ranges::find(volume.channels, name);
    if (found == volume.channels.end()) return std::nullopt;
    return static_cast<std::size_t>(found - volume.channels.begin());
}

// The parameters in the entry of an asset that is made of a cloud volume.
template <class Asset>
struct RecordedSource {
    Asset bake;
    CloudVolumeBake of;
    Cloud cloud;
};

// Returns them, or nothing where the entry is not what a bake writes.
template <class Asset>
std::optional<RecordedSource<Asset>> recorded_source(const ManifestAsset& asset) {
    const auto recipe = config::parse_asset_parameters(asset.parameters, asset.name).value;
    if (!recipe) return std::nullopt;
    for (const config::Bake& bake : recipe->parameters.bakes) {
        const Asset* own = bake.name == asset.name ? bake.template find<Asset>() : nullptr;
        if (own == nullptr || own->contents.size() != asset.channels.size()) continue;
        // A recipe that was read names a cloud volume of a cloud that is there.
        const auto& of = bake_named(recipe->parameters, own->of).template as<CloudVolumeBake>();
        return RecordedSource<Asset>{*own, of, cloud_named(recipe->parameters, of.cloud)};
    }
    return std::nullopt;
}

// Compares each asset of a kind with the volume that it is made of, where that is in the folder.
// `recorded(asset)` is what its entry says, with the asset's struct as `bake`, or nothing;
// `fault(asset, volume, recorded)` says what is wrong, or nothing. `check` is the check's name.
template <class Recorded, class Fault>
std::vector<VerifyFailure> check_against_volumes(const Manifest& manifest, const std::string& kind,
                                                 const std::string& check, int& checks,
                                                 const Recorded& recorded, const Fault& fault) {
    std::vector<VerifyFailure> failures;
    for (const ManifestAsset& asset : manifest.assets) {
        if (asset.kind != kind || asset.files.empty()) continue;
        const auto fail = [&](std::string message) {
            failures.push_back({asset.files.front().path, check, std::move(message)});
        };
        const auto wanted = recorded(asset);
        if (!wanted) {
            ++checks;
            fail("its parameters cannot be read as a recipe");
            continue;
        }
        const ManifestAsset* volume = asset_named(manifest, wanted->bake.of);
        if (volume == nullptr || !volume->is_volume()) continue;  // baked elsewhere
        ++checks;
        std::string found = fault(asset, *volume, *wanted);
        if (!found.empty()) fail(std::move(found));
    }
    return failures;
}

}  // namespace skybake
