// What one preview looks at.
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "bakers/render/preview_asset.h"
#include "config/recipe/recipe.h"

namespace skybake {

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

}  // namespace skybake
