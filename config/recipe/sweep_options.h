// This header holds what the command line of `skybake sweep` says of the values that vary.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "config/recipe/recipe_sources.h"

namespace skybake::config {

struct SweepOptions {
    std::vector<std::string> vary;     // "a.b=0.2:0.8:4", "a.b=1:100:3:log", "a.b=1,2,3"
    std::vector<std::string> zip;      // "a.b,c.d"
    std::optional<std::string> sobol;  // "64"
};

// Lays the options over a recipe's own [sweep], each option as a separate source. An entry replaces
// the one of the same path. Malformed options are reported (E0122).
void add_sweep_options(const SweepOptions& options, RecipeSources& sources,
                       DiagnosticList& diagnostics);

}  // namespace skybake::config
