// The recipe that a VDB or NanoVDB file stands for where a recipe is expected.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "config/recipe/recipe.h"

namespace skybake::cli {

// Whether the argument names a VDB or NanoVDB file that says of itself neither, nor a manifest beside
// it, which asset it holds.
bool is_foreign_volume(std::string_view argument);

// Returns a recipe of the file as [bake.cloud] with at most 256 voxels along an axis, and `settings` as
// those of --set. Its optical depth is 20 along its height at density 1. E0300, E0304, and a recipe's.
Outcome<Recipe> recipe_of_volume(const std::string& file, std::span<const std::string> settings);

}  // namespace skybake::cli
