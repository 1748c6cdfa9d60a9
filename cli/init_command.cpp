// skybake init: a commented recipe to start from.
#include <fmt/format.h>

#include <array>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <utility>

#include "bakers/io/files/atomic_file.h"
#include "bakers/io/files/file_diagnostic.h"
#include "bakers/io/files/output_folder.h"
#include "cli/command.h"
#include "cli/console.h"
#include "cli/event_line.h"
#include "cli/parse_arguments.h"
#include "cli/preset_kinds.h"
#include "cli/table_printer.h"
#include "config/presets/presets.h"

namespace skybake::cli {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr std::string_view default_file = "skybake.toml";
constexpr std::string_view standard_output = "-";

std::string preset_list() {
    std::string text;
    for (const PresetKind& kind : preset_kinds()) {
        text += fmt::format("{}{}: {}\n", text.empty() ? "" : "\n", kind.plural, kind.use);
        TextTable table({}, 2);
        for (const config::Preset& preset : kind.all()) {
            table.add_row({std::string(preset.name), config::preset_title(preset)});
        }
        text += table.text();
    }
    return text +
           "\n`skybake init FILE --preset NAME` writes a recipe from a preset of any kind except "
           "layers\n";
}

std::string preset_list_event() {
    Json presets = Json::array();
    for (const PresetKind& kind : preset_kinds()) {
        for (const config::Preset& preset : kind.all()) {
            presets.push_back({{"kind", kind.name},
                               {"name", preset.name},
                               {"title", config::preset_title(preset)},
                               {"makes_recipe", kind.recipe != nullptr}});
        }
    }
    return event_line({{"event", "presets"}, {"presets", std::move(presets)}});
}

// The one preset that a name means. E0115: there is none, or there are several.
config::Outcome<KnownPreset> preset_of(const std::string& name) {
    const auto presets = presets_for_init(name);
    if (presets.size() == 1) return {presets.front(), {}};
    if (presets.empty()) return {{}, {unknown_preset(name)}};
    config::Diagnostic diagnostic =
        usage_error(fmt::format("several presets have the name `{}`", name),
                    fmt::format("name it with its kind: {}", full_names(presets)));
    diagnostic.code = "E0115";
    return {{}, {std::move(diagnostic)}};
}

config::Diagnostic would_overwrite(const std::string& file) {
    config::Diagnostic diagnostic =
        file_error("E0303", file, fmt::format("`{}` exists and would be overwritten", file));
    diagnostic.label = "overwrite it with --force";
    return diagnostic;
}

ExitCode write_recipe(const std::string& file, const KnownPreset& preset, bool force,
                      Console& console) {
    std::error_code error;
    const bool exists = fs::symlink_status(file, error).type() != fs::file_type::not_found;
    if (exists && !force) return console.report(std::array{would_overwrite(file)});
    const auto folder = create_output_folder(fs::absolute(file).parent_path());
    if (!folder.value) return console.report(folder.diagnostics);
    const auto outcome = write_file_atomically(file, preset.recipe());
    const ExitCode code = console.report(outcome.diagnostics);
    if (!outcome.value) return code;
    console.result(console.display().json ? event_line({{"event", "recipe_written"},
                                                        {"path", file},
                                                        {"preset", preset.full_name()}})
                                          : file + '\n');
    console.note(
        fmt::format("{} was written from the preset {}\n"
                    "next: skybake bake {} -o out\n",
                    file, preset.full_name(), file));
    return ExitCode::done;
}

void print_recipe(const KnownPreset& preset, Console& console) {
    const std::string text = preset.recipe();
    console.result(
        console.display().json
            ? event_line({{"event", "recipe"}, {"preset", preset.full_name()}, {"text", text}})
            : text);
}

ExitCode run_init(const Invocation& invocation, Console& console) {
    if (invocation.has("list")) {
        console.result(console.display().json ? preset_list_event() : preset_list());
        return ExitCode::done;
    }
    const auto preset = preset_of(invocation.value("preset"));
    if (!preset.value) return console.report(preset.diagnostics);
    const auto& arguments = invocation.arguments();
    const std::string file = arguments.empty() ? std::string(default_file) : arguments[0];
    if (const auto meant = presets_for_init(file); !meant.empty()) {
        return console.report(
            std::array{usage_error(fmt::format("`{}` is the name of a preset, not of a file", file),
                                   init_command_of(meant, file))});
    }
    if (file == standard_output) {
        print_recipe(*preset.value, console);
        return ExitCode::done;
    }
    return write_recipe(file, *preset.value, invocation.has("force"), console);
}

}  // namespace

Command init_command() {
    return {
        .name = "init",
        .brief = "write a recipe",
        .summary = "write a commented recipe from a preset",
        .arguments = {{.name = "file",
                       .help = "the recipe to write (default skybake.toml); - prints it",
                       .required = false}},
        .options = {{.name = "preset",
                     .value = "NAME",
                     .help = "the preset to start from, such as clouds.thesis",
                     .fallback = "earth"},
                    {.name = "list", .help = "list the presets of each kind and write nothing"},
                    {.name = "force", .help = "overwrite an existing file"}},
        .examples = {{"skybake init earth.toml",
                      "writes the Earth's atmosphere, with the meaning of every value"},
                     {"skybake init mars.toml --preset mars", "writes another planet"},
                     {"skybake init noise.toml --preset nubis_shape", "writes a noise for clouds"},
                     {"skybake init cloud.toml --preset clouds.thesis", "writes a cloud"},
                     {"skybake init fog.toml --preset fog", "writes the droplets of fog"},
                     {"skybake init --list", "lists the presets, one per line"}},
        .exit_codes = {ExitCode::io},
        .run = run_init};
}

}  // namespace skybake::cli
