// What `bake`, `report` and `preview` share of the command line: the recipe, which of its assets,
// how many threads.
#pragma once

#include <vector>

#include "cli/command.h"
#include "config/recipe/recipe.h"

namespace skybake::cli {

// Declarations of --set, --only and --jobs.
Option set_option();
Option only_option(std::string_view help);
Option jobs_option(std::string_view help);

// The number of threads that --jobs asks for; 0, as many as the machine has, where it is not given.
// E0001.
config::Outcome<int> jobs_of(const Invocation& invocation);

struct BakeSelection {
    config::Recipe recipe;
    std::vector<config::Bake> bakes;  // all of the recipe, or those that --only names
    int threads = 0;                  // 0: as many as the machine has
};

// Reads the recipe named by the first argument with its --set values. The recipe's own diagnostics;
// E0001 for --only and --jobs, E0124 for a recipe that asks for nothing, E0300 and E0304 for maps
// that cannot be read.
config::Outcome<BakeSelection> select_bakes(const Invocation& invocation);

}  // namespace skybake::cli
