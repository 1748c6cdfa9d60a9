// Variants of a recipe: the same recipe with some keys changed. A report measures them, and so does
// whoever compares ways to make an asset.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "config/diagnostics/diagnostic.h"
#include "config/recipe/recipe.h"

namespace skybake {

// Reads a recipe with more settings than those that its user gave, "bake.sky.size=[192, 108]".
using LoadRecipe =
    std::function<config::Outcome<config::Recipe>(std::span<const std::string> settings)>;

// Returns a TOML value as tables show it: "256x64" for "[256, 64]", "half" for a text in quotes.
std::string plain_value(std::string_view toml);

struct Variant {
    std::string family;    // the key that differs: "pixel_type"; of the recipe itself "this recipe"
    std::string name;      // its value: "half"
    std::string baseline;  // whose published method it is; or empty
    std::vector<std::string> settings;
};

// Returns the recipe itself and its variants, each of which differs in one of the keys that the
// asset's baker names (Baker::variants): half and double a size or a number, every other choice.
std::vector<Variant> variants_of(const config::Recipe& recipe, const config::Bake& bake);

}  // namespace skybake
