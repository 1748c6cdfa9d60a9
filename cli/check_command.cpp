// skybake check: all errors of a recipe, nothing baked.
#include <fmt/format.h>

#include <string>
#include <string_view>

#include "bakers/phase/check_particles.h"
#include "cli/bake_selection.h"
#include "cli/command.h"
#include "cli/console.h"
#include "config/recipe.h"

namespace skybake::cli {
namespace {

std::string count(std::size_t number, std::string_view what) {
    return fmt::format("{} {}{}", number, what, number == 1 ? "" : "s");
}

// "3 layers, 1 noise, 1 cloud, 2 assets to bake": layers, noises and clouds where the recipe is
// about them.
std::string contents(const config::Parameters& parameters) {
    std::string text;
    const bool has_atmosphere = parameters.atmosphere.ground_radius.meters > 0;
    if (has_atmosphere) text += count(parameters.atmosphere.layers.size(), "layer") + ", ";
    if (!parameters.particles.empty())
        text += fmt::format("{} of particles, ", count(parameters.particles.size(), "kind"));
    if (!parameters.noises.empty()) text += count(parameters.noises.size(), "noise") + ", ";
    if (!parameters.clouds.empty()) text += count(parameters.clouds.size(), "cloud") + ", ";
    return text + count(parameters.bakes.size(), "asset") + " to bake";
}

ExitCode run_check(const Invocation& invocation, Console& console) {
    const std::string& file = invocation.arguments()[0];
    const auto outcome = config::load_recipe(file, invocation.values("set"));
    const ExitCode code = console.report_results(outcome.diagnostics);
    if (!outcome.value) return code;
    const auto problems = check_particles(outcome.value->parameters);
    if (!problems.empty()) return console.report_results(problems);
    console.note(fmt::format("{}: no errors; {}\n", file, contents(outcome.value->parameters)));
    return code;
}

}  // namespace

Command check_command() {
    return {.name = "check",
            .brief = "find all its errors",
            .summary = "find all errors of a recipe, bake nothing",
            .arguments = {{.name = "recipe.toml", .help = "the recipe to check"}},
            .options = {set_option()},
            .examples = {{"skybake check earth.toml", "every error with its line and a remedy"},
                         {"skybake check earth.toml --diagnostics json", "the same for an editor"}},
            .exit_codes = {ExitCode::io},
            .run = run_check};
}

}  // namespace skybake::cli
