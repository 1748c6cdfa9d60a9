// Checks the files that the clouds of a recipe are made from, before any of them is baked.
#pragma once

#include <vector>

#include "config/diagnostics/diagnostic.h"
#include "config/sections/parameters.h"

namespace skybake {

// Reads every map and volume that the recipe names, even if no bake needs it. Returns E0300
// and E0304 at the recipe's line.
[[nodiscard]] std::vector<Diagnostic> check_cloud_files(const Parameters& parameters);

}  // namespace skybake
