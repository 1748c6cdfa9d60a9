// Checks the options of a preview: finds options that no picture uses, and a camera above the air.
// Also reduces a recipe for drafts.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "bakers/preview/bake_assets.h"
#include "bakers/preview/make_preview.h"
#include "config/diagnostics/diagnostic.h"
#include "config/recipe/recipe.h"
#include "config/sections/parameters.h"

namespace skybake {

// Returns which pictures of light a preview will have.
LitPictures lit_pictures_of(std::span<const config::Bake> bakes);
LitPictures lit_pictures_of(const PreviewAssets& assets);

// Makes an E0001: what is wrong with the options, and what is meant or allowed.
[[nodiscard]] config::Diagnostic option_fault(std::string message, std::string label);

// Returns E0001 for each given option that no picture uses.
[[nodiscard]] std::vector<config::Diagnostic> unused_options(const LitPictures& lit,
                                                             const PreviewOptions& options);

// Returns warnings (W0216) of the keys that the recipe's own [preview] has and that no picture of its
// bakes uses.
[[nodiscard]] std::vector<config::Diagnostic> unused_keys(const config::Recipe& recipe);

// Returns E0110 if a sky is to be shown and options.altitude_m is above the top of its air, where
// the tables end.
[[nodiscard]] std::optional<config::Diagnostic> camera_above_air(const PreviewAssets& assets,
                                                                 const PreviewOptions& options);

// Returns warnings (W0218) of cloud volumes that reach the sides of their tile, if single tiles are
// shown.
[[nodiscard]] std::vector<config::Diagnostic> clouds_cut_by_tile(const PreviewAssets& assets,
                                                                 const PreviewOptions& options);

// Reduces a recipe for a draft. Volumes have at most `most_voxels` along an edge, in the same
// proportions, and only level 0. Tables have fixed sizes of at most 256 x 64 and 32 x 32 texels,
// instead of an error bound, and texels of multiple scattering may have errors of 2 %. Nothing else
// changes, so pictures look like the recipe's. Octaves that are too fine for so few voxels alias or
// vanish; load_recipe would refuse this in an ordinary recipe.
config::Recipe draft_of(config::Recipe recipe, int most_voxels);

}  // namespace skybake
