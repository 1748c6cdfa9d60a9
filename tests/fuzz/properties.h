// What must hold of every recipe that parses, checked for the fuzzers.
#pragma once

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <variant>

#include "config/recipe.h"

namespace skybake::config::fuzzing {

inline void require(bool holds, const char* property) {
    if (holds) return;
    std::fprintf(stderr, "property broken: %s\n", property);
    std::abort();
}

inline bool within(double value, double minimum, double maximum) {
    return value >= minimum && value <= maximum;  // false for NaN
}

inline void check_layer(const Layer& layer, std::size_t channels) {
    require(layer.enabled, "only enabled layers are left");
    require(layer.scattering.size() == channels, "one scattering coefficient per channel");
    require(layer.extinction.size() == channels, "one extinction coefficient per channel");
    for (std::size_t i = 0; i < channels; ++i) {
        const double scattering = layer.scattering[i].per_meter;
        const double extinction = layer.extinction[i].per_meter;
        require(within(scattering, 0, 1e6), "scattering in range");
        require(within(extinction, scattering, 1e6), "extinction from scattering up");
    }
    require(std::fabs(layer.g) < 1, "g in (-1, 1)");
    if (layer.profile == Profile::exponential) {
        require(within(layer.scale_height.meters, 1e-3, 1e9), "scale height in range");
    }
    if (layer.profile == Profile::tent) {
        require(within(layer.half_width.meters, 1e-3, 1e9), "half width in range");
    }
    if (layer.profile == Profile::slab) {
        require(layer.top_altitude.meters > layer.bottom_altitude.meters, "slab has a thickness");
    }
    if (layer.profile == Profile::tabulated) {
        require(layer.table.size() >= 2, "at least two entries");
        require(layer.table[0].altitude.meters >= 0, "no negative altitude");
        for (std::size_t i = 1; i < layer.table.size(); ++i) {
            require(layer.table[i].altitude.meters > layer.table[i - 1].altitude.meters,
                    "altitudes increase");
        }
        for (const DensityPoint& point : layer.table) {
            require(within(point.density, 0, 1e6), "density in range");
        }
    }
}

template <class Asset>
void check_asset(const Asset& asset) {
    if (asset.max_error) {
        require(within(*asset.max_error, 1e-7, 1), "max_error in range");
        return;
    }
    for (const int texels : asset.size) require(texels >= 1 && texels <= 16384, "size in range");
}

inline void check_parameters(const Parameters& parameters) {
    const std::size_t channels = parameters.wavelengths.size();
    require(channels == 1 || channels == 3, "one channel or three");
    const Atmosphere& atmosphere = parameters.atmosphere;
    require(within(atmosphere.ground_radius.meters, 1, 1e12), "ground radius in range");
    require(within(atmosphere.top_radius.meters, 1, 1e12), "top radius in range");
    require(atmosphere.top_radius.meters > atmosphere.ground_radius.meters, "top above ground");
    require(atmosphere.ground_albedo.size() == channels, "one albedo per channel");
    for (const double albedo : atmosphere.ground_albedo)
        require(within(albedo, 0, 1), "albedo in range");
    for (const Layer& layer : atmosphere.layers) check_layer(layer, channels);
    for (const Bake& bake : parameters.bakes) {
        require(!bake.name.empty() && bake.name.find('/') == std::string::npos,
                "a name for a file");
        std::visit([](const auto& asset) { check_asset(asset); }, bake.asset);
    }
}

inline std::string canonical_text(const Recipe& recipe) {
    const std::string patterns[] = {"*", "*.*", "*.*.*", "*.*.*.*"};
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
    check_parameters(outcome.value->parameters);
    const std::string canonical = canonical_text(*outcome.value);
    const Outcome<Recipe> again = parse_recipe(canonical, "canonical.toml");
    require(again.value.has_value(), "canonical text is a recipe");
    require(canonical_text(*again.value) == canonical, "canonical text is stable");
}

}  // namespace skybake::config::fuzzing
