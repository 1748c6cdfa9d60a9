// The small recipes that several tests bake, in tests/recipes.
#pragma once

#include <string>

namespace skybake::test {

// Returns the text of tests/recipes/NAME.toml.
std::string recipe_text(const std::string& name);

}  // namespace skybake::test
