// Options that none of a preview's pictures uses.
#pragma once

#include <span>
#include <vector>

#include "bakers/preview/make_preview.h"
#include "bakers/preview/preview_assets.h"
#include "config/diagnostics/diagnostic.h"
#include "config/sections/parameters.h"

namespace skybake {

LitPictures lit_pictures_of(std::span<const config::Bake> bakes);
LitPictures lit_pictures_of(const PreviewAssets& assets);

// E0001 for each option that was given and that no picture uses.
std::vector<config::Diagnostic> unused_options(const LitPictures& lit,
                                               const PreviewOptions& options);

}  // namespace skybake
