// skybake init: a commented recipe to start from.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "bakers/io/atomic_file.h"
#include "bakers/io/file_diagnostic.h"
#include "cli/command.h"
#include "cli/console.h"
#include "cli/parse_arguments.h"
#include "cli/table_printer.h"
#include "config/init_text.h"
#include "config/presets.h"
#include "config/suggest.h"

namespace skybake::cli {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view default_file = "skybake.toml";
constexpr std::string_view standard_output = "-";

std::string titles(std::span<const config::Preset> presets) {
    TextTable table({}, 2);
    for (const config::Preset& preset : presets) {
        table.add_row({std::string(preset.name), config::preset_title(preset)});
    }
    return table.text();
}

std::string preset_list() {
    return "atmospheres: preset = \"NAME\" at the top of a recipe\n" + titles(config::presets()) +
           "\nnoises: preset = \"NAME\" below [noise.ANY_NAME]\n" +
           titles(config::noise_presets()) +
           "\nparticles: preset = \"NAME\" below [particles.ANY_NAME]\n" +
           titles(config::particle_presets()) +
           "\nlayers: preset = \"NAME\" below [atmosphere.layers.ANY_NAME]\n" +
           titles(config::layer_presets()) +
           "\nclouds: preset = \"NAME\" below [clouds.ANY_NAME]; init --preset clouds.NAME\n" +
           titles(config::cloud_presets());
}

// The recipe of a preset of any kind; none if there is none of that name. "clouds.thesis" is the
// cloud where "thesis" is the noise of that name.
std::optional<std::string> recipe_text(std::string_view name) {
    constexpr std::string_view clouds = "clouds.";
    const bool is_cloud = name.starts_with(clouds);
    if (is_cloud) name.remove_prefix(clouds.size());
    const auto* preset = is_cloud ? nullptr : config::find_preset(name);
    if (preset) return config::init_text(*preset);
    const auto* noise = is_cloud ? nullptr : config::find_noise_preset(name);
    if (noise) return config::noise_init_text(*noise);
    const auto* cloud = config::find_cloud_preset(name);
    if (cloud) return config::cloud_init_text(*cloud);
    const auto* particles =
        is_cloud ? nullptr : config::find_preset(config::particle_presets(), name);
    if (!particles) return std::nullopt;
    return config::particle_init_text(*particles);
}

config::Diagnostic unknown_preset(const std::string& name) {
    if (config::find_preset(config::layer_presets(), name)) {
        return usage_error(fmt::format("`{}` is the preset of a layer, not of a recipe", name),
                           fmt::format("preset = \"{}\" below [atmosphere.layers.ANY_NAME]", name));
    }
    auto names = config::preset_names();
    for (const config::SectionPresets& kind : config::section_presets()) {
        for (const std::string_view other : config::preset_names(kind.all())) {
            const bool is_known = std::find(names.begin(), names.end(), other) != names.end();
            if (!is_known) names.push_back(other);
        }
    }
    std::string label = config::did_you_mean(name, names);
    if (label.empty()) label = fmt::format("there are: {}", fmt::join(names, ", "));
    config::Diagnostic diagnostic = usage_error(fmt::format("unknown preset `{}`", name), label);
    diagnostic.code = "E0115";
    return diagnostic;
}

config::Diagnostic would_overwrite(const std::string& file) {
    config::Diagnostic diagnostic =
        file_error("E0303", file, fmt::format("`{}` exists and would be overwritten", file));
    diagnostic.label = "--force overwrites it";
    return diagnostic;
}

ExitCode write_recipe(const std::string& file, const std::string& text, bool force,
                      Console& console) {
    std::error_code error;
    const bool exists = fs::symlink_status(file, error).type() != fs::file_type::not_found;
    if (exists && !force) return console.report(std::array{would_overwrite(file)});
    const auto outcome = write_file_atomically(file, text);
    const ExitCode code = console.report(outcome.diagnostics);
    if (!outcome.value) return code;
    console.result(file + '\n');
    console.note(fmt::format("next: skybake bake {} -o out\n", file));
    return ExitCode::done;
}

ExitCode run_init(const Invocation& invocation, Console& console) {
    if (invocation.has("list")) {
        console.result(preset_list());
        return ExitCode::done;
    }
    const std::string name = invocation.value("preset");
    const std::optional<std::string> text = recipe_text(name);
    if (!text) return console.report(std::array{unknown_preset(name)});
    const auto& arguments = invocation.arguments();
    const std::string file = arguments.empty() ? std::string(default_file) : arguments[0];
    if (recipe_text(file)) {
        return console.report(
            std::array{usage_error(fmt::format("`{}` is the name of a preset, not of a file", file),
                                   fmt::format("skybake init {}.toml --preset {}", file, file))});
    }
    if (file == standard_output) {
        console.result(*text);
        return ExitCode::done;
    }
    return write_recipe(file, *text, invocation.has("force"), console);
}

}  // namespace

Command init_command() {
    return {.name = "init",
            .brief = "write a recipe",
            .summary = "write a commented recipe from a preset",
            .arguments = {{.name = "file",
                           .help = "the recipe to write (default skybake.toml); - is stdout",
                           .required = false}},
            .options = {{.name = "preset",
                         .value = "NAME",
                         .help = "what to start from",
                         .fallback = "earth"},
                        {.name = "list", .help = "list the presets and write nothing"},
                        {.name = "force", .help = "overwrite an existing file"}},
            .examples = {{"skybake init earth.toml", "the Earth, every value with its meaning"},
                         {"skybake init mars.toml --preset mars", "another planet"},
                         {"skybake init clouds.toml --preset nubis_shape", "a cloud noise"},
                         {"skybake init clouds.toml --preset clouds.thesis", "a cloud"},
                         {"skybake init fog.toml --preset fog", "the droplets of fog"},
                         {"skybake init --list", "the presets, a line each"}},
            .exit_codes = {ExitCode::io},
            .run = run_init};
}

}  // namespace skybake::cli
