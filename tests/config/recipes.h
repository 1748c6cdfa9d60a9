// Shared by the tests of config/: recipes from text, diagnostics by code.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "config/recipe/recipe.h"
#include "config/sections/layer.h"
#include "tests/support/outcomes.h"
#include "tests/support/temporary_folder.h"

namespace skybake::config::testing {

using skybake::testing::TemporaryFolder;

inline Outcome<Recipe> parse(const std::string& text,
                             const std::vector<std::string>& settings = {}) {
    return parse_recipe(text, "test.toml", {}, settings);
}

// "E0102 2:1" for each diagnostic; settings have no line.
inline std::vector<std::string> codes_and_places(const std::vector<Diagnostic>& diagnostics) {
    std::vector<std::string> result;
    for (const Diagnostic& diagnostic : diagnostics) {
        result.push_back(diagnostic.code + ' ' + std::to_string(diagnostic.where.line) + ':' +
                         std::to_string(diagnostic.where.column));
    }
    return result;
}

// The recipe of a text that must be without fault.
inline Recipe valid(const std::string& text, const std::vector<std::string>& settings = {}) {
    return test::without_diagnostics(parse(text, settings));
}

// The same for a text that may earn warnings.
inline Recipe valid_with_warnings(const std::string& text) {
    return test::without_errors(parse(text));
}

// The resolved value at a path; an empty one, and a failure, if there is none.
inline ResolvedValue value_at(const Recipe& recipe, const std::string& path) {
    for (const ResolvedValue& value : recipe.values) {
        if (value.path == path) return value;
    }
    ADD_FAILURE() << "no value " << path;
    return {};
}

inline bool has_value(const Recipe& recipe, const std::string& path) {
    return std::ranges::count(recipe.values, path, &ResolvedValue::path) > 0;
}

inline const Layer* find_layer(const Parameters& parameters, const std::string& name) {
    for (const Layer& layer : parameters.atmosphere.layers) {
        if (layer.name == name) return &layer;
    }
    return nullptr;
}

// All that files carry, so equal texts mean equal parameters.
inline std::string all_parameters(const Recipe& recipe) {
    const std::string patterns[] = {"*", "*.*", "*.*.*", "*.*.*.*", "*.*.*.*.*"};
    return parameters_toml(recipe, patterns);
}

}  // namespace skybake::config::testing

namespace skybake::config {

// Tests speak of these.
using testing::all_parameters;
using testing::find_layer;
using testing::has_value;
using testing::parse;
using testing::valid;
using testing::value_at;

}  // namespace skybake::config
