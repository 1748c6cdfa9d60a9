// skybake check: all errors of a recipe, nothing baked.
#include <fmt/format.h>

#include <string>
#include <string_view>

#include "cli/bake_selection.h"
#include "cli/command.h"
#include "cli/console.h"
#include "config/recipe.h"

namespace skybake::cli {
namespace {

std::string count(std::size_t number, std::string_view what) {
    return fmt::format("{} {}{}", number, what, number == 1 ? "" : "s");
}

ExitCode run(const Invocation& invocation, Console& console) {
    const std::string& file = invocation.arguments()[0];
    const auto outcome = config::load_recipe(file, invocation.values("set"));
    const ExitCode code = console.report_results(outcome.diagnostics);
    if (!outcome.value) return code;
    const config::Parameters& parameters = outcome.value->parameters;
    console.note(fmt::format("{}: no errors; {}, {} to bake\n", file,
                             count(parameters.atmosphere.layers.size(), "layer"),
                             count(parameters.bakes.size(), "asset")));
    return code;
}

}  // namespace

Command check_command() {
    return {.name = "check",
            .summary = "find all errors of a recipe, bake nothing",
            .arguments = {{.name = "recipe.toml", .help = "the recipe to check"}},
            .options = {set_option()},
            .examples = {{"skybake check earth.toml", "every error with its line and a remedy"},
                         {"skybake check earth.toml --diagnostics json", "the same for an editor"}},
            .exit_codes = {ExitCode::io},
            .run = run};
}

}  // namespace skybake::cli
