// What a recipe asks for, baked in memory for a preview; no file is written.
#pragma once

#include <map>
#include <span>
#include <string>

#include "bakers/math/bake_options.h"
#include "bakers/preview/preview_assets.h"
#include "bakers/render/stage_progress.h"
#include "config/diagnostics/diagnostic.h"
#include "config/recipe/recipe.h"

namespace skybake {

// What was baked before, so that it need not be again: by AssetIdentity::key, of recipes that were
// all reduced in the same way or not at all.
struct AssetMemory {
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
                                           AssetMemory* memory = nullptr,
                                           const BakeStages& stages = {});

}  // namespace skybake
