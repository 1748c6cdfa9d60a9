// skybake init: writes a commented recipe to start from.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <utility>

#include "bakers/io/files/atomic_file.h"
#include "bakers/io/files/file_io.h"
#include "bakers/io/files/output_folder.h"
#include "cli/console.h"
#include "cli/events.h"
#include "cli/options.h"
#include "cli/table_printer.h"
#include "config/presets/presets.h"
#include "config/recipe/init_text.h"
#include "config/text/mapped.h"
#include "config/text/text.h"

namespace skybake::cli {
namespace options {

inline const Option<std::string> preset{"preset", 0, "NAME"};
inline const Option<bool> list{"list"};

}  // namespace options

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

// --- Kinds of presets ---------------------------------------------------------------------------

struct PresetKind {
    std::string_view name;    // "clouds": the part before the dot of "clouds.thesis"
    std::string_view plural;  // "clouds", for lists
    std::string_view use;     // how a recipe names such a preset
    std::span<const config::Preset> (*all)();
    std::string (*recipe)(const config::Preset& preset);  // init's text; null: it writes none
};
struct KnownPreset {
    const PresetKind* kind = nullptr;
    const config::Preset* preset = nullptr;

    std::string_view name() const { return preset->name; }
    // Returns the full name: "clouds.thesis".
    std::string full_name() const { return fmt::format("{}.{}", kind->name, preset->name); }
    std::string recipe() const { return kind->recipe(*preset); }
};

// The kinds stand in the order in which `init` lists them.
constexpr std::array<PresetKind, 5> kinds = {{
    {"atmosphere", "atmospheres", "preset = \"NAME\" at the top of a recipe",
     [] { return config::presets(); }, config::init_text},
    {"noise", "noises", "preset = \"NAME\" below [noise.ANY_NAME]", config::noise_presets,
     config::noise_init_text},
    {"particles", "particles", "preset = \"NAME\" below [particles.ANY_NAME]",
     config::particle_presets, config::particle_init_text},
    {"layers", "layers", "preset = \"NAME\" below [atmosphere.layers.ANY_NAME]",
     config::layer_presets, nullptr},
    {"clouds", "clouds", "preset = \"NAME\" below [clouds.ANY_NAME]", config::cloud_presets,
     config::cloud_init_text},
}};

// Returns the presets that `init` can write, kind after kind.
std::vector<KnownPreset> presets_to_write() {
    std::vector<KnownPreset> presets;
    for (const PresetKind& kind : kinds) {
        if (kind.recipe == nullptr) continue;
        for (const config::Preset& preset : kind.all()) presets.push_back({&kind, &preset});
    }
    return presets;
}

std::vector<std::string> names_with(std::string_view piece) {
    std::vector<std::string> names;
    for (const KnownPreset& known : presets_to_write()) {
        if (known.name().find(piece) != std::string_view::npos) names.push_back(known.full_name());
    }
    return names;
}

// Suggests what the user may have meant by a name that no preset has.
std::string preset_hint(const std::string& name) {
    for (const PresetKind& kind : kinds) {
        const bool is_kind = name == kind.name || name == kind.plural;
        if (!is_kind || kind.recipe == nullptr) continue;
        return fmt::format("{}: {}", kind.plural,
                           fmt::join(config::preset_names(kind.all()), ", "));
    }
    const std::string nearest = config::did_you_mean(
        name, mapped<std::string_view>(presets_to_write(), &KnownPreset::name));
    if (!nearest.empty()) return nearest;
    constexpr std::size_t shortest_piece = 3;
    const auto names = name.size() < shortest_piece ? std::vector<std::string>() : names_with(name);
    if (!names.empty()) return fmt::format("did you mean {}?", fmt::join(names, " or "));
    return "`skybake init --list` lists the presets of each kind";
}

// Returns the presets of that name that `init` can write: none, one, or one of each kind
// ("thesis"). A full name such as "clouds.thesis" fits one preset.
std::vector<KnownPreset> presets_for_init(std::string_view name) {
    const std::size_t dot = name.find('.');
    const bool has_kind = dot != std::string_view::npos;
    const std::string_view own = has_kind ? name.substr(dot + 1) : name;
    std::vector<KnownPreset> found = presets_to_write();
    std::erase_if(found, [&](const KnownPreset& known) {
        return known.name() != own || (has_kind && known.kind->name != name.substr(0, dot));
    });
    return found;
}

// Returns the command that writes a recipe from the first of the presets. It uses `name` if that
// fits just this preset, else the preset's full name.
std::string init_command_of(std::span<const KnownPreset> presets, std::string_view name) {
    const KnownPreset& first = presets.front();
    return fmt::format("skybake init {}.toml --preset {}", first.preset->name,
                       presets.size() == 1 ? std::string(name) : first.full_name());
}

// Returns E0115: there is no such preset, or it is a preset of a layer. The label suggests presets
// that may be meant.
Diagnostic unknown_preset(const std::string& name) {
    if (config::find_preset(config::layer_presets(), name) != nullptr) {
        return diagnosis(
            "E0115", fmt::format("`{}` is the preset of a layer and not of a whole recipe", name),
            fmt::format("write preset = \"{}\" below [atmosphere.layers.ANY_NAME]", name));
    }
    return diagnosis("E0115", fmt::format("there is no preset `{}`", name), preset_hint(name));
}

// --- The command --------------------------------------------------------------------------------

constexpr std::string_view default_file = "skybake.toml";
constexpr std::string_view standard_output = "-";

std::string preset_list() {
    std::string text;
    for (const PresetKind& kind : kinds) {
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
    for (const PresetKind& kind : kinds) {
        for (const config::Preset& preset : kind.all()) {
            presets.push_back({{"kind", kind.name},
                               {"name", preset.name},
                               {"title", config::preset_title(preset)},
                               {"makes_recipe", kind.recipe != nullptr}});
        }
    }
    return event_line({{"event", "presets"}, {"presets", std::move(presets)}});
}

// Returns the one preset that a name means. Reports E0115 if there is none or there are several.
Outcome<KnownPreset> preset_of(const std::string& name) {
    const auto presets = presets_for_init(name);
    if (presets.size() == 1) return {presets.front(), {}};
    if (presets.empty()) return unknown_preset(name);
    const auto names = mapped<std::string>(presets, &KnownPreset::full_name);
    return diagnosis("E0115", fmt::format("several presets have the name `{}`", name),
                     fmt::format("name it with its kind: {}", fmt::join(names, " or ")));
}

Diagnostic would_overwrite(const std::string& file) {
    return file_error("E0303", file, fmt::format("`{}` exists and would be overwritten", file),
                      "overwrite it with --force");
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
    console.result(console.json() ? event_line({{"event", "recipe_written"},
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
        console.json()
            ? event_line({{"event", "recipe"}, {"preset", preset.full_name()}, {"text", text}})
            : text);
}

ExitCode run_init(const Invocation& invocation, Console& console) {
    if (invocation[options::list]) {
        console.result(console.json() ? preset_list_event() : preset_list());
        return ExitCode::done;
    }
    const auto preset = preset_of(invocation[options::preset]);
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
    return write_recipe(file, *preset.value, invocation[options::force], console);
}

OptionRow preset_row() {
    OptionRow row = options::preset("the preset to start from, such as clouds.thesis", "earth");
    row.offered = names_with("");
    for (const KnownPreset& known : presets_to_write()) {
        if (presets_for_init(known.name()).size() == 1) row.offered.emplace_back(known.name());
    }
    return row;
}

}  // namespace

std::optional<Diagnostic> preset_in_place_of_file(const std::filesystem::path& path) {
    std::error_code error;
    if (fs::exists(fs::symlink_status(path, error))) return std::nullopt;
    const auto presets = presets_for_init(path.string());
    if (presets.empty()) return std::nullopt;
    return file_error(
        "E0300", "", fmt::format("`{}` is a preset and not a file", path.string()),
        fmt::format("write a recipe from it: {}", init_command_of(presets, path.string())));
}

Command init_command() {
    return {
        .name = "init",
        .brief = "write a recipe",
        .summary = "write a commented recipe from a preset",
        .arguments = {{.name = "file",
                       .help = "the recipe to write (default skybake.toml); - prints it",
                       .required = false}},
        .options = {preset_row(), options::list("list the presets of each kind and write nothing"),
                    options::force("overwrite an existing file")},
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
