// skybake schema: prints the JSON Schemas of what people write and of what skybake writes.
#include "config/recipe/schema.h"

#include <fmt/format.h>

#include <array>
#include <string>

#include "bakers/io/manifest/manifest.h"
#include "bakers/workspace/sweep/index_files.h"
#include "cli/command.h"
#include "cli/console.h"
#include "cli/events.h"
#include "cli/plan_page.h"
#include "config/text/text.h"

namespace skybake::cli {
namespace {

struct Schema {
    std::string_view name;
    std::string (*text)();
};

constexpr std::array schemas = {
    Schema{"recipe", config::recipe_schema},
    Schema{"manifest", manifest_schema},
    Schema{"sweep", [] { return std::string(sweep_schema()); }},
    Schema{"events", event_schema},
    Schema{"plan", plan_schema},
};

ExitCode run_schema(const Invocation& invocation, Console& console) {
    const auto& arguments = invocation.arguments();
    const std::string name = arguments.empty() ? std::string(schemas[0].name) : arguments[0];
    std::vector<std::string_view> names;
    for (const Schema& schema : schemas) {
        names.push_back(schema.name);
        if (schema.name != name) continue;
        console.result(schema.text());
        return ExitCode::done;
    }
    std::string label = config::did_you_mean(name, names);
    if (label.empty()) label = "recipe, manifest, sweep, events or plan";
    return console.report(
        std::array{usage_error(fmt::format("there is no schema `{}`", name), label)});
}

}  // namespace

Command schema_command() {
    return {
        .name = "schema",
        .brief = "print JSON Schemas",
        .summary = "print the JSON Schema of recipes, manifests, sweeps, plans or the events of --json",
        .arguments = {{.name = "what",
                       .help = "recipe (default), manifest, sweep, events or plan",
                       .required = false,
                       .choices = {"recipe", "manifest", "sweep", "events", "plan"}}},
        .examples = {{"skybake schema > recipe.schema.json", "serves an editor's TOML mode"},
                     {"skybake schema manifest", "describes manifest.json"}},
        .run = run_schema};
}

}  // namespace skybake::cli
