// Bakes of the recipes that tests write.
#pragma once

#include <string>
#include <vector>

#include "bakers/assets/registry/registry.h"
#include "bakers/field/baked.h"
#include "tests/support/atmospheres.h"

namespace skybake::test {

// Bakes the first asset of a recipe.
inline config::Outcome<Baked> bake_first(const config::Recipe& recipe,
                                         const BakeOptions& options = {.threads = 1}) {
    return bake_asset(recipe, recipe.parameters.bakes.at(0), options);
}

inline config::Outcome<Baked> bake_first(const std::string& text,
                                         const BakeOptions& options = {.threads = 1},
                                         const std::vector<std::string>& settings = {}) {
    return bake_first(recipe_of(text, settings), options);
}

}  // namespace skybake::test
