// Checks what must hold of every recipe that parses, for the fuzzers.
#pragma once

#include <regex>
#include <string>
#include <vector>

#include "config/fields/fields.h"
#include "config/recipe/recipe.h"
#include "config/sections/layer.h"
#include "config/sections/noise.h"
#include "config/text/key_path.h"
#include "config/text/units.h"
#include "tests/fuzz/asset_properties.h"

namespace skybake::config::fuzzing {

inline void check_atmosphere(const Parameters& parameters) {
    const std::size_t channels = parameters.wavelengths.size();
    const Atmosphere& atmosphere = parameters.atmosphere;
    require(atmosphere.top_radius.meters > atmosphere.ground_radius.meters, "top above ground");
    require(atmosphere.ground_albedo.size() == channels, "one albedo per channel");
    for (const Layer& layer : atmosphere.layers) check_layer(layer, channels);
}

inline bool is_in(const Range& range, double value) {
    if (range.or_zero && value == 0) return true;
    return within(value, range.minimum, range.maximum) &&
           !(range.open_minimum && value == range.minimum) &&
           !(range.open_maximum && value == range.maximum);
}

// Every number is in the range of its key, wherever it comes from.
inline void check_ranges(const std::vector<ResolvedValue>& values) {
    static const std::regex items(R"--("([^"]*)"|[-+]?(?:[0-9]|inf|nan)[^,\]]*)--");
    std::string asset;
    for (const ResolvedValue& value : values) {
        std::vector<std::string> names = split_path(value.path).value();
        const std::string key = names.back();
        names.pop_back();
        if (key == "asset") asset = value.canonical.substr(1, value.canonical.size() - 2);
        for (const Section& section : sections()) {
            const bool is_its = section.asset.empty() || section.asset == asset;
            const Field* field = find_field(section, key);
            if (!is_its || !names_fit(names, section) || !field || !field->kind.scale) continue;
            const std::string& text = value.canonical;
            for (std::sregex_iterator item(text.begin(), text.end(), items), end; item != end;
                 ++item) {
                const bool is_text = (*item)[1].matched;  // a quantity, or a word
                const auto number = parse_quantity((*item)[is_text ? 1 : 0].str());
                const auto* quantity = std::get_if<Quantity>(&number);
                if (is_text && !quantity) continue;
                require(quantity && is_in(field->range, quantity->value),
                        (value.path + " = " + text + " is out of range").c_str());
            }
        }
    }
}

inline void check_parameters(const Parameters& parameters) {
    const std::size_t channels = parameters.wavelengths.size();
    require(channels >= 1, "at least one wavelength");
    for (const Noise& noise : parameters.noises) check_noise(noise);
    for (const Cloud& cloud : parameters.clouds) check_cloud(cloud, parameters);
    for (const Bake& bake : parameters.bakes) {
        require(!bake.name.empty() && bake.name.find('/') == std::string::npos,
                "a name for a file");
        visit_asset(bake, [&](const auto& asset) { check_asset(asset, parameters); });
    }
    if (parameters.atmosphere.ground_radius.meters > 0) check_atmosphere(parameters);
}

inline std::string canonical_text(const Recipe& recipe) {
    const std::string patterns[] = {"*", "*.*", "*.*.*", "*.*.*.*", "*.*.*.*.*"};
    return parameters_toml(recipe, patterns);
}

// Either a recipe in range whose canonical text is a recipe of the same canonical text, or an
// error.
inline void check_outcome(const Outcome<Recipe>& outcome) {
    bool has_error = false;
    for (const Diagnostic& diagnostic : outcome.diagnostics) {
        require(!diagnostic.code.empty() && !diagnostic.message.empty(),
                "diagnostics say something");
        require(diagnostic.where.line >= 0 && diagnostic.where.column >= 0, "places are places");
        has_error = has_error || diagnostic.severity == Severity::error;
    }
    require(outcome.value.has_value() != has_error, "a value, or an error");
    if (!outcome.value) return;
    check_ranges(outcome.value->values);
    check_parameters(outcome.value->parameters);
    const std::string canonical = canonical_text(*outcome.value);
    const Outcome<Recipe> again = parse_recipe(canonical, "canonical.toml");
    require(again.value.has_value(), "canonical text is a recipe");
    require(canonical_text(*again.value) == canonical, "canonical text is stable");
}

}  // namespace skybake::config::fuzzing
