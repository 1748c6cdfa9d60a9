// Assets that are made from another asset, as a folder holds them: their files, and what their entries
// of the manifest say. For checks of a whole folder.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bakers/io/manifest/manifest.h"
#include "bakers/io/manifest/verify.h"
#include "config/recipe/recipe.h"

namespace skybake {

// Returns the asset of this name, or null.
const ManifestAsset* asset_named(const Manifest& manifest, const std::string& name);

// Returns the first file that holds the volume itself and can be read back, or null.
const ManifestFile* first_file(const ManifestAsset& asset);

// Returns the index of a volume's channel of this name, or of its first one where the name is empty.
// Returns none if it has no such channel.
std::optional<std::size_t> channel_in(const ManifestAsset& volume, const std::string& name);

// Returns the recipe in an asset's entry. None: it cannot be read.
std::optional<Recipe> recorded_recipe(const ManifestAsset& asset);

// Returns the asset's own section of the recipe in its entry, or null where the entry is not what a
// bake writes.
template <class Bake>
const Bake* recorded_bake(const Recipe& recipe, const ManifestAsset& asset) {
    for (const config::Bake& bake : recipe.parameters.bakes) {
        if (bake.name != asset.name) continue;
        const Bake* own = bake.template find<Bake>();
        return own && own->contents.size() == asset.channels.size() ? own : nullptr;
    }
    return nullptr;
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
