// Reads the parameters that a baked asset carries: the keys on which its values depend, as text in TOML.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "config/recipe/recipe.h"

namespace skybake::config {

// Returns them as a recipe. Recipes must say what their ground reflects, but the parameters of an
// asset lack it if its values do not depend on it, as those of a transmittance do: such a ground is
// black. `name` stands in diagnostics.
Outcome<Recipe> parse_asset_parameters(std::string_view text, const std::string& name);

// Returns the section of the asset itself among these, which may hold the bakes that it is made of
// too: the one of its name, or the only one, as a file may have another name. Null if there is none.
const Bake* own_bake(const Parameters& parameters, std::string_view name);

// Returns what the section says, or nothing if it cannot be read or is of another asset.
template <class Asset>
std::optional<Asset> recorded_bake(std::string_view text, const std::string& name) {
    const Outcome<Recipe> recipe = parse_asset_parameters(text, name);
    const Bake* own = recipe.value ? own_bake(recipe.value->parameters, name) : nullptr;
    const Asset* asset = own != nullptr ? own->find<Asset>() : nullptr;
    return asset != nullptr ? std::optional(*asset) : std::nullopt;
}

}  // namespace skybake::config
