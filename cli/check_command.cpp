// skybake check: reports all errors of a recipe and bakes nothing.
#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "bakers/air/particles/layer_phase.h"
#include "bakers/assets/cloud_volume/cloud_inputs.h"
#include "bakers/assets/registry/registry.h"
#include "cli/command.h"
#include "cli/console.h"
#include "cli/events.h"
#include "cli/options.h"
#include "cli/table_printer.h"
#include "config/recipe/recipe.h"
#include "config/sections/cloud.h"
#include "config/sections/layer.h"
#include "config/sections/particles.h"
#include "config/sections/volume.h"

namespace skybake::cli {
namespace {

// Returns "3 layers, 1 noise, 1 cloud, 2 assets to bake". Layers, noises and clouds are named only
// if the recipe is about them.
std::string contents(const Parameters& parameters) {
    std::string text;
    const bool has_atmosphere = parameters.atmosphere.ground_radius.meters > 0;
    if (has_atmosphere) text += counted(parameters.atmosphere.layers.size(), "layer") + ", ";
    if (!parameters.particles.empty())
        text += fmt::format("{} of particles, ", counted(parameters.particles.size(), "kind"));
    if (!parameters.noises.empty()) text += counted(parameters.noises.size(), "noise") + ", ";
    if (!parameters.volumes.empty()) text += counted(parameters.volumes.size(), "volume") + ", ";
    if (!parameters.clouds.empty()) text += counted(parameters.clouds.size(), "cloud") + ", ";
    return text + counted(parameters.bakes.size(), "asset") + " to bake";
}

std::string checked_event(const std::string& name, const Parameters& parameters,
                          const std::vector<Diagnostic>& warnings) {
    const bool has_atmosphere = parameters.atmosphere.ground_radius.meters > 0;
    return event_line({{"event", "checked"},
                       {"recipe", name},
                       {"layers", has_atmosphere ? parameters.atmosphere.layers.size() : 0},
                       {"particles", parameters.particles.size()},
                       {"noises", parameters.noises.size()},
                       {"volumes", parameters.volumes.size()},
                       {"clouds", parameters.clouds.size()},
                       {"assets", parameters.bakes.size()},
                       {"warnings", diagnostics_json(warnings)}});
}

ExitCode run_check(const Invocation& invocation, Console& console) {
    const std::string name = recipe_name(invocation.arguments()[0]);
    const auto outcome = recipe_of(invocation);
    const ExitCode code = console.report_results(outcome.diagnostics);
    if (!outcome.value) return code;
    auto problems = check_particles(outcome.value->parameters);
    const auto unreadable = check_cloud_files(outcome.value->parameters);
    problems.insert(problems.end(), unreadable.begin(), unreadable.end());
    if (problems.empty()) problems = check_air(*outcome.value);
    const ExitCode found = console.report_results(problems);
    if (found != ExitCode::done) return found;
    const Parameters& parameters = outcome.value->parameters;
    if (console.json()) {
        problems.insert(problems.begin(), outcome.diagnostics.begin(), outcome.diagnostics.end());
        console.result(checked_event(name, parameters, problems));
    }
    console.note(fmt::format("{}: no errors; {}\n", name, contents(parameters)));
    return code;
}

}  // namespace

Command check_command() {
    return {
        .name = "check",
        .brief = "find its errors",
        .summary = "find all errors of a recipe without baking it",
        .arguments = {{.name = "recipe.toml", .help = recipe_help}},
        .options = {set_row()},
        .examples = {{"skybake check earth.toml", "shows every error with its line and a remedy"},
                     {"skybake check - < earth.toml", "checks the text that an editor pipes in"},
                     {"skybake check earth.toml --json", "reports the errors to a program"}},
        .exit_codes = {ExitCode::io, ExitCode::checks},
        .run = run_check};
}

}  // namespace skybake::cli
