// Checks the options of a preview: finds options that no picture uses, and a camera above the air.
// Also reduces a recipe for drafts.
//
// Completes the options of a preview by what the recipe's [preview] says, and places the sun.
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

// Returns the options with the values of [preview] for those that are not given and that a picture
// uses. A time and a place become the sun's elevation and azimuth, where +y is north and +x is east,
// with a note on them for the page. A sun on the command line replaces the time of the recipe, and a
// time there replaces the recipe's sun. Contact sheets of sweeps keep their own size. `recipe` may be
// null.
//
// Reports E0001 for a time without a place, for a place without a time, and for a time together with
// an elevation or azimuth.
Outcome<PreviewOptions> completed(PreviewOptions options, const Recipe* recipe,
                                  const LitPictures& lit);

// Returns which pictures of light a preview will have.
LitPictures lit_pictures_of(std::span<const Bake> bakes);
LitPictures lit_pictures_of(const PreviewAssets& assets);

// Returns E0001 for each given option that no picture uses.
[[nodiscard]] std::vector<Diagnostic> unused_options(const LitPictures& lit,
                                                     const PreviewOptions& options);

// Returns warnings (W0216) of the keys that the recipe's own [preview] has and that no picture of its
// bakes uses.
[[nodiscard]] std::vector<Diagnostic> unused_keys(const Recipe& recipe);

// Returns E0110 if the camera of skies or of clouds is to stand above the top of the air, where the
// tables end.
[[nodiscard]] std::optional<Diagnostic> camera_above_air(const PreviewAssets& assets,
                                                         const PreviewOptions& options);

// Returns warnings (W0218) of cloud volumes that reach the sides of their tile, if single tiles are
// shown.
[[nodiscard]] std::vector<Diagnostic> clouds_cut_by_tile(const PreviewAssets& assets,
                                                         const PreviewOptions& options);

// Reduces a recipe for a draft. Volumes have at most `most_voxels` along an edge, in the same
// proportions, and only level 0. Tables have fixed sizes of at most 256 x 64 and 32 x 32 texels,
// instead of an error bound, and texels of multiple scattering may have errors of 2 %. Nothing else
// changes, so pictures look like the recipe's. Octaves that are too fine for so few voxels alias or
// vanish; load_recipe would refuse this in an ordinary recipe.
Recipe draft_of(Recipe recipe, int most_voxels);

}  // namespace skybake
