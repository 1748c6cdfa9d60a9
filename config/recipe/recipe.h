// This header reads recipe files into resolved parameters. It handles presets, includes, --set,
// merging and every check. It also writes parameters as text and compares such texts.
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "config/diagnostics/diagnostic.h"
#include "config/fields/roles.h"
#include "config/sections/parameters.h"
#include "config/sections/preview.h"
#include "config/sweep/sweep.h"

namespace skybake::config {

struct Recipe {
    Parameters parameters;
    std::optional<Preview> preview;             // how pictures show the recipe
    std::vector<ResolvedValue> values;          // in the order of the field tables, layers by name
    std::vector<std::filesystem::path> inputs;  // recipe, includes, maps: for dependency files
    Sweep sweep;                                // what [sweep] varies
    std::vector<ResolvedValue> sweep_values;    // the values of [sweep], for `show`
};

// Reads a recipe file. `settings` are the texts of --set, such as "a.b=c", in order.
Outcome<Recipe> load_recipe(const std::filesystem::path& path,
                            std::span<const std::string> settings = {});

// Reads a recipe from a text in memory. `name` stands for the file in diagnostics. Its includes are
// looked for in `folder`.
Outcome<Recipe> parse_recipe(std::string_view text, const std::string& name,
                             const std::filesystem::path& folder = {},
                             std::span<const std::string> settings = {});

// The command line of `skybake sweep` says this of the values that vary.
struct SweepOptions {
    std::vector<std::string> vary;     // "a.b=0.2:0.8:4", "a.b=1:100:3:log", "a.b=1,2,3"
    std::vector<std::string> zip;      // "a.b,c.d"
    std::optional<std::string> sobol;  // "64"
};

// Reads what a recipe's [sweep] and the options of the command line vary. Other faults of the
// recipe are not reported here; they are found when the variants are read.
Outcome<Sweep> load_sweep(const std::filesystem::path& path, std::span<const std::string> settings,
                          const SweepOptions& options);

// Reads one variant of a sweep: the recipe with the variant's values laid over it. The result has
// an empty `sweep`.
Outcome<Recipe> load_variant(const std::filesystem::path& path,
                             std::span<const std::string> settings, const Sweep& sweep, int index);

// Returns the resolved values that an asset with these reads is made from, as TOML text. It has one
// `path = canonical` per line, grouped under table headers.
std::string parameters_toml(const Recipe& recipe, std::span<const Read> reads);

// Returns the values whose path matches one of the patterns, as the same kind of text. A `*` in a
// pattern matches one path component.
std::string parameters_toml(const Recipe& recipe, std::span<const std::string> patterns);

// This is one difference between two texts of resolved parameters, as parameters_toml writes them.
struct ParameterChange {
    std::string path;    // "clouds.cumulus.threshold"
    std::string before;  // TOML; empty if the parameter was not there
    std::string after;   // TOML; empty if the parameter is gone
};

// Returns the changes sorted by path. Everything is new if `before` cannot be read as TOML.
std::vector<ParameterChange> parameter_changes(std::string_view before, std::string_view after);

// Describes a change and shortens long values: "clouds.cumulus.threshold 0.35 → 0.4".
std::string change_text(const ParameterChange& change);

}  // namespace skybake::config

namespace skybake {
using config::Recipe;
}  // namespace skybake
