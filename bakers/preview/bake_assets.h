// What a recipe asks for, baked in memory for a preview; no file is written.
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "bakers/math/bake_options.h"
#include "bakers/render/sky_tables.h"
#include "bakers/render/stage_progress.h"
#include "config/diagnostics/diagnostic.h"
#include "config/recipe/recipe.h"

namespace skybake {

// What one preview looks at.
struct PreviewAssets {
    std::string title;  // "earth.toml", "out"
    std::vector<PreviewAsset> assets;
    std::optional<config::Recipe> recipe;      // that made them: without, there is no sky to show
    std::map<std::string, std::string> plots;  // speed against error as SVG, by the asset's name
    std::vector<std::string> notes;            // what is not shown, and why

    // The first asset of that kind, or null.
    const PreviewAsset* of_kind(std::string_view kind) const;
};

// The most values (voxels times channels) of a volume that a preview holds in memory: 1 GiB. The
// pictures of a volume are a few slices and passes over all of it; what is larger is shown at its
// first level of detail that is not.
inline constexpr std::size_t most_previewed_values = std::size_t{1} << 28;

// The first level that a preview can hold, or none.
std::optional<std::size_t> previewed_level(const ManifestAsset& asset);

// `asset` as though its level of detail `level` were all that there is.
ManifestAsset at_level(const ManifestAsset& asset, std::size_t level);

// What a note says of an asset that is not shown at its full size.
std::string level_note(const ManifestAsset& asset, std::optional<std::size_t> level);

// What was baked before, so that it need not be again: by AssetIdentity::key, of recipes that were
// all reduced in the same way or not at all.
struct AssetMemo {
    std::map<std::string, PreviewAsset> assets;
};

// Who is told of each asset as a stage of `count`.
struct BakeStages {
    StageProgress* progress = nullptr;
    int count = 0;
};

// Bakes the sections `bakes` of the recipe (its own, or reduced ones of the same names). Values are
// rounded to the pixel type, as a file would hold them. What `memory` has is taken from there; it
// keeps what was shown this time, and no more. Diagnostics as of bake_asset. No value and no
// diagnostics: the user has interrupted.
config::Outcome<PreviewAssets> bake_assets(const config::Recipe& recipe,
                                           std::span<const config::Bake> bakes,
                                           const std::string& title, const BakeOptions& options,
                                           AssetMemo* memory = nullptr,
                                           const BakeStages& stages = {});

}  // namespace skybake
