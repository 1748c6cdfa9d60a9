// The cloud volume that another asset is made of: its `of` names the bake.
//
// Assets whose texels are blocks of a volume's voxels: where they lie, and what they are called.
//
// Assets that are made from another asset, as a folder holds them: their files, and what their entries
// of the manifest say. For checks of a whole folder.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "bakers/assets/cloud_volume/cloud_volume.h"
#include "bakers/assets/registry/baker.h"
#include "bakers/field/conventions.h"
#include "bakers/io/manifest/manifest.h"
#include "bakers/io/manifest/verify.h"
#include "bakers/math/bake_options.h"
#include "bakers/occupancy/cell_grid.h"
#include "config/assets/cloud_volume.h"
#include "config/diagnostics/diagnostic.h"
#include "config/recipe/recipe.h"
#include "config/sections/parameters.h"

namespace skybake {

struct Baked;

// Returns the bake that `of` names. A recipe that was read has it.
const CloudVolumeBake& source_volume(const Parameters& parameters, const std::string& of);

// Returns the voxels of that volume as its files hold them, which it shares with the volume's own
// bake. Adds what its cloud is made of to the details of `made`, which is made of them, and their
// time to its own. Returns E0300 or E0304 if a file of the cloud cannot be read, and neither value
// nor diagnostics after an interruption.
Outcome<Baked> hold_source_volume(const Parameters& parameters, const std::string& of,
                                  const BakeOptions& options, Baked& made);

// Returns whether a march may sum the densities of the volume as its files hold them.
bool is_marched_as_stored(const Cloud& cloud);

// Returns what an asset that is made of a cloud volume needs, for its baker's row.
template <class Asset>
std::vector<Need> needs_of_source(const Parameters& parameters, const Asset& asset, Certification) {
    return needs_of_voxels(parameters, source_volume(parameters, asset.of));
}

// Returns the files that such an asset reads, for its baker's row.
template <class Asset>
std::vector<InputFile> inputs_of_source(const Parameters& parameters, const Asset& asset) {
    return cloud_volume_inputs(parameters, source_volume(parameters, asset.of));
}

// Returns the edges of what the blocks of a volume span, which may go on beyond the volume.
Uvw spanned_m(const occupancy::CellGrid& grid, const Cloud& cloud);

// How files speak of the blocks.
struct BlockWords {
    std::string_view block;  // "cell" or "texel"; constants of the axes begin with it
    std::string place;       // where block i of an axis is, behind "repeats; " or "clamped; "
    AxisFilter filter = AxisFilter::linear;
};

// Fills in what says where the blocks of `of` lie: mapping, axes, edges, corner and conventions. Blocks
// go on beyond the volume where they do not divide it.
void place_blocks(const Baked& of, const occupancy::CellGrid& grid, const BlockWords& words,
                  Baked& volume);

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
