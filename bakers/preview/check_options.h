// What options ask of a preview: which of them no picture uses, whether the camera is within the
// air, and a recipe made smaller.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "bakers/preview/bake_assets.h"
#include "bakers/preview/make_preview.h"
#include "config/diagnostics/diagnostic.h"
#include "config/recipe/recipe.h"
#include "config/sections/parameters.h"

namespace skybake {

// What of its pictures is lit.
LitPictures lit_pictures_of(std::span<const config::Bake> bakes);
LitPictures lit_pictures_of(const PreviewAssets& assets);

// E0001 for each option that was given and that no picture uses.
[[nodiscard]] std::vector<config::Diagnostic> unused_options(const LitPictures& lit,
                                                             const PreviewOptions& options);

// E0110 where options.altitude_m is above the top of the air of a sky that is to be shown: the
// tables end there. Nothing where there is no sky to show.
[[nodiscard]] std::optional<config::Diagnostic> camera_above_air(const PreviewAssets& assets,
                                                                 const PreviewOptions& options);

// Volumes of at most `most_voxels` along an edge in their own proportions and without further
// levels of detail; tables of at most 256 x 64 and 32 x 32 texels, with a fixed size in place of an
// error to be reached, and texels of multiple scattering that may be 2 % off. Nothing else differs,
// so the look is the recipe's. Octaves too fine for so few voxels alias or vanish, which
// load_recipe would have refused of the recipe itself.
config::Recipe draft_of(config::Recipe recipe, int most_voxels);

}  // namespace skybake
