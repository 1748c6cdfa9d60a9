// The recipe that a folder was baked from, as its manifest recorded it.
#pragma once

#include "bakers/io/manifest/manifest.h"
#include "config/diagnostics/diagnostic.h"
#include "config/recipe/recipe.h"

namespace skybake {

// Parses manifest.parameters again. All values are there, resolved, so that the outcome's
// parameters equal those of the bake; but a bake of a part (`--only`) recorded the recipe of that
// day alone, and maps are looked for in `folder`, where includes are not. `name` stands for the
// manifest in diagnostics. E0304: the recorded values are none that this release would record.
config::Outcome<config::Recipe> recorded_recipe(const Manifest& manifest, const std::string& name,
                                                const std::filesystem::path& folder);

}  // namespace skybake
