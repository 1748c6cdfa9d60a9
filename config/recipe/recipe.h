// From recipe files to resolved parameters: presets, includes, --set, merging and every check.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "config/diagnostics/diagnostic.h"
#include "config/fields/roles.h"
#include "config/recipe/sweep_options.h"
#include "config/sections/parameters.h"
#include "config/sweep/sweep.h"

namespace skybake::config {

struct Recipe {
    Parameters parameters;
    std::vector<ResolvedValue> values;          // in the order of the field tables, layers by name
    std::vector<std::filesystem::path> inputs;  // recipe, includes and maps, for dependency files
    Sweep sweep;                                // what [sweep] varies
    std::vector<ResolvedValue> sweep_values;    // of [sweep], for `show`
};

// Reads a recipe file. `settings` are the texts of --set, "a.b=c", in order.
Outcome<Recipe> load_recipe(const std::filesystem::path& path,
                            std::span<const std::string> settings = {});

// The same for a text in memory; `name` stands for the file in diagnostics, `folder` is where its
// includes are looked for.
Outcome<Recipe> parse_recipe(std::string_view text, const std::string& name,
                             const std::filesystem::path& folder = {},
                             std::span<const std::string> settings = {});

// What a recipe's [sweep] and the options of the command line vary. The recipe's other faults are
// for the variants to find.
Outcome<Sweep> load_sweep(const std::filesystem::path& path, std::span<const std::string> settings,
                          const SweepOptions& options);

// One variant of it: the recipe with its values laid over it. Has no `sweep` itself.
Outcome<Recipe> load_variant(const std::filesystem::path& path,
                             std::span<const std::string> settings, const Sweep& sweep, int index);

// The resolved values that an asset is made from which reads these, as TOML text (one
// `path = canonical` a line, grouped under table headers).
std::string parameters_toml(const Recipe& recipe, std::span<const Read> reads);

// Those whose path matches one of the patterns, in which a `*` matches one path component.
std::string parameters_toml(const Recipe& recipe, std::span<const std::string> patterns);

// What has changed between two texts of resolved parameters, as parameters_toml writes them.
struct ParameterChange {
    std::string path;    // "clouds.cumulus.threshold"
    std::string before;  // TOML; empty where it was not there
    std::string after;   // the same
};

// By path. Everything is new where `before` cannot be read as TOML.
std::vector<ParameterChange> parameter_changes(std::string_view before, std::string_view after);

// "clouds.cumulus.threshold 0.35 → 0.4", long values shortened.
std::string change_text(const ParameterChange& change);

}  // namespace skybake::config
