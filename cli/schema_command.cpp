// skybake schema: prints the JSON Schemas of what people write and of what skybake writes.
#include "cli/schema_command.h"

#include <fmt/format.h>

#include <array>
#include <string>
#include <utility>

#include "cli/command.h"
#include "cli/console.h"
#include "config/recipe/schema.h"
#include "config/sections/file_formats.h"
#include "config/text/text.h"

namespace skybake::cli {
namespace {

struct Schema {
    std::string_view name;
    const char* file;  // null: made of the keys
};

constexpr std::array schemas = {
    Schema{"recipe", nullptr},
    Schema{"manifest", "manifest_schema.json"},
    Schema{"sweep", "sweep_schema.json"},
    Schema{"events", "event_schema.json"},
    Schema{"plan", "plan_schema.json"},
};

// Returns the text of a JSON Schema in which "@formats@" is replaced by the names of all formats
// and "@image_formats@" by those of images: "exr", "vdb", ...
std::string with_formats(std::string_view schema) {
    std::string all;
    std::string images;
    for (const config::FormatFacts& format : config::file_formats) {
        const std::string name = fmt::format("\"{}\"", format.name);
        all += (all.empty() ? "" : ", ") + name;
        if (format.is_image) images += (images.empty() ? "" : ", ") + name;
    }
    std::string text(schema);
    for (const auto& [mark, names] :
         {std::pair("\"@formats@\"", all), std::pair("\"@image_formats@\"", images)}) {
        for (std::size_t at; (at = text.find(mark)) != std::string::npos;) {
            text.replace(at, std::string_view(mark).size(), names);
        }
    }
    return text;
}

ExitCode run_schema(const Invocation& invocation, Console& console) {
    const auto& arguments = invocation.arguments();
    const std::string name = arguments.empty() ? std::string(schemas[0].name) : arguments[0];
    std::vector<std::string_view> names;
    for (const Schema& schema : schemas) {
        names.push_back(schema.name);
        if (schema.name != name) continue;
        console.result(schema.file ? with_formats(schema_text(schema.file))
                                   : config::recipe_schema());
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
