// Completes the options of a preview by what the recipe's [preview] says, and places the sun.
#pragma once

#include "bakers/preview/make_preview.h"
#include "config/diagnostics/diagnostic.h"
#include "config/recipe/recipe.h"

namespace skybake {

// Returns the options with the values of [preview] for those that are not given and that a picture
// uses. A time and a place become the sun's elevation and azimuth, where +y is north and +x is east,
// with a note on them for the page. A sun on the command line replaces the time of the recipe, and a
// time there replaces the recipe's sun. Contact sheets of sweeps keep their own size. `recipe` may be
// null.
//
// Reports E0001 for a time without a place, for a place without a time, and for a time together with
// an elevation or azimuth.
config::Outcome<PreviewOptions> completed(PreviewOptions options, const config::Recipe* recipe,
                                          const LitPictures& lit);

}  // namespace skybake
