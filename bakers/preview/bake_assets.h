// What a recipe asks for, baked in memory for a preview; no file is written.
#pragma once

#include <span>
#include <string>

#include "bakers/core/bake_options.h"
#include "bakers/preview/preview_assets.h"
#include "config/diagnostic.h"
#include "config/recipe.h"

namespace skybake {

// Bakes the sections `bakes` of the recipe (its own, or reduced ones of the same names). Values are
// rounded to the pixel type, as a file would hold them. Diagnostics as of bake_asset. No value and
// no diagnostics: the user has interrupted.
config::Outcome<PreviewAssets> bake_assets(const config::Recipe& recipe,
                                           std::span<const config::Bake> bakes,
                                           const std::string& title, const BakeOptions& options);

}  // namespace skybake
