// Reads the parameters that a baked asset carries: the keys on which its values depend, as text in TOML.
#pragma once

#include <string>
#include <string_view>

#include "config/recipe/recipe.h"

namespace skybake::config {

// Returns them as a recipe. Recipes must say what their ground reflects, but the parameters of an
// asset lack it if its values do not depend on it, as those of a transmittance do: such a ground is
// black. `name` stands in diagnostics.
Outcome<Recipe> parse_asset_parameters(std::string_view text, const std::string& name);

}  // namespace skybake::config
