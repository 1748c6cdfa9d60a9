// Bakes the assets of a recipe in memory for a preview. No file is written.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "bakers/math/bake_options.h"
#include "bakers/render/sky_tables.h"
#include "bakers/render/stage_progress.h"
#include "bakers/workspace/asset_cache.h"
#include "config/diagnostics/diagnostic.h"
#include "config/recipe/recipe.h"

namespace skybake {

// The assets that one preview shows.
struct PreviewAssets {
    std::string title;  // "earth.toml", "out"
    std::vector<PreviewAsset> assets;
    std::optional<Recipe> recipe;              // the assets' recipe; without it no sky is shown
    std::map<std::string, std::string> plots;  // speed against error as SVG, by the asset's name
    std::vector<std::string> notes;            // on what is not shown, and why

    // Returns the asset of that kind whose light has the smallest error in skies, the first one where
    // none was measured, or null.
    const PreviewAsset* of_kind(std::string_view kind) const;
};

// The most values (voxels times channels) of an asset that a preview holds in memory, which take 1
// GiB. The pictures of a volume need it in memory: a few slices, and passes over all its voxels.
inline constexpr std::size_t most_previewed_values = std::size_t{1} << 28;

// What a preview shows of an asset that may be larger: its first level of detail that is small enough,
// or else means over cubes of its last one.
struct ShownLevel {
    std::size_t level = 0;
    int edge = 1;  // of the cubes, in voxels
    bool is_whole() const { return level == 0 && edge == 1; }
};

ShownLevel shown_level(const ManifestAsset& asset);

// Returns `asset` as if it had only the level that is shown.
ManifestAsset at_level(const ManifestAsset& asset, const ShownLevel& shown);

// Returns the note on an asset that is not shown at its full size.
std::string level_note(const ManifestAsset& asset, const ShownLevel& shown);

// The texels of a level that is shown, channels interleaved.
class ShownTexels {
  public:
    ShownTexels(const std::array<int, 3>& size, std::size_t channels, int edge);

    // Adds `count` texels of the level from number `first` on.
    void add(std::int64_t first, std::int64_t count, const float* texels);

    std::vector<float> values;

  private:
    const std::array<int, 3> size_;
    const std::size_t channels_;
    const int edge_;
};

// A memo of assets that were baked before, by AssetIdentity::key. All recipes that use the same
// memo must be reduced in the same way or not at all, and not at all if it has sources or a cache.
struct AssetMemo {
    std::map<std::string, PreviewAsset> assets;
    std::map<std::string, PreviewAsset> unfinished;  // of the last bake, if that was interrupted
    // Are asked, in this order, for the files of assets that the memo lacks. Files of assets that were
    // certified better than the bake asks for serve as well. Those that differ from their manifest
    // are left alone.
    std::vector<AssetSource*> sources;
    std::vector<std::string> ready;  // names of those assets of the last bake that came from files
    AssetCache* cache = nullptr;     // is offered the tables that are baked
    bool keeps_all = false;          // does not forget what the last bake did not show
};

// The progress that each asset is reported to, as one stage of `count`.
struct BakeStages {
    StageProgress* progress = nullptr;
    int count = 0;
};

// Bakes the sections `bakes` of the recipe, which are its own or reduced ones of the same names.
// Values are rounded to the pixel type, as a file would hold them. Assets in `memory` are not baked
// again; afterwards it keeps exactly the assets shown this time, unless it keeps all. Diagnostics are those of
// bake_asset. If the user interrupts, there is neither a value nor a diagnostic.
Outcome<PreviewAssets> bake_assets(const Recipe& recipe, std::span<const Bake> bakes,
                                   const std::string& title, const BakeOptions& options,
                                   AssetMemo* memory = nullptr, const BakeStages& stages = {});

}  // namespace skybake
