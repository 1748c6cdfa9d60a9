// What one preview looks at.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "bakers/preview/preview_asset.h"
#include "config/parameters.h"

namespace skybake {

struct PreviewAssets {
    std::string title;  // "earth.toml", "out"
    std::vector<PreviewAsset> assets;
    // Of the recipe that made them: without, no sky and no lit cloud can be shown.
    std::optional<config::Parameters> parameters;
    std::vector<std::string> notes;  // what is not shown, and why
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
