#include "cli/preset_kinds.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>

#include "cli/parse_arguments.h"
#include "config/recipe/init_text.h"
#include "config/text/suggest.h"

namespace skybake::cli {
namespace {

// In the order in which `init` lists them.
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

std::vector<std::string> names_with(std::string_view piece) {
    std::vector<std::string> names;
    for (const PresetKind& kind : kinds) {
        if (kind.recipe == nullptr) continue;
        for (const config::Preset& preset : kind.all()) {
            if (preset.name.find(piece) != std::string_view::npos) {
                names.push_back(KnownPreset{&kind, &preset}.full_name());
            }
        }
    }
    return names;
}

std::string nearest_preset(const std::string& name) {
    std::vector<std::string_view> names;
    for (const PresetKind& kind : kinds) {
        if (kind.recipe == nullptr) continue;
        for (const config::Preset& preset : kind.all()) names.push_back(preset.name);
    }
    return config::did_you_mean(name, names);
}

// What someone may have meant by a name that no preset has.
std::string preset_hint(const std::string& name) {
    for (const PresetKind& kind : kinds) {
        const bool is_kind = name == kind.name || name == kind.plural;
        if (!is_kind || kind.recipe == nullptr) continue;
        return fmt::format("{}: {}", kind.plural,
                           fmt::join(config::preset_names(kind.all()), ", "));
    }
    const std::string nearest = nearest_preset(name);
    if (!nearest.empty()) return nearest;
    constexpr std::size_t shortest_piece = 3;
    const auto names = name.size() < shortest_piece ? std::vector<std::string>() : names_with(name);
    if (!names.empty()) return fmt::format("did you mean {}?", fmt::join(names, " or "));
    return "`skybake init --list` lists the presets of each kind";
}

}  // namespace

std::span<const PresetKind> preset_kinds() { return kinds; }

std::string KnownPreset::full_name() const {
    return fmt::format("{}.{}", kind->name, preset->name);
}

std::vector<KnownPreset> presets_for_init(std::string_view name) {
    std::vector<KnownPreset> found;
    for (const PresetKind& kind : kinds) {
        if (kind.recipe == nullptr) continue;
        const bool has_kind = name.size() > kind.name.size() && name.starts_with(kind.name) &&
                              name[kind.name.size()] == '.';
        const std::string_view own = has_kind ? name.substr(kind.name.size() + 1) : name;
        if (const auto* preset = config::find_preset(kind.all(), own)) {
            found.push_back({&kind, preset});
        }
    }
    return found;
}

std::string init_command_of(std::span<const KnownPreset> presets, std::string_view name) {
    const KnownPreset& first = presets.front();
    return fmt::format("skybake init {}.toml --preset {}", first.preset->name,
                       presets.size() == 1 ? std::string(name) : first.full_name());
}

config::Diagnostic unknown_preset(const std::string& name) {
    const bool of_layer = config::find_preset(config::layer_presets(), name) != nullptr;
    config::Diagnostic diagnostic =
        of_layer
            ? usage_error(
                  fmt::format("`{}` is the preset of a layer and not of a whole recipe", name),
                  fmt::format("write preset = \"{}\" below [atmosphere.layers.ANY_NAME]", name))
            : usage_error(fmt::format("there is no preset `{}`", name), preset_hint(name));
    diagnostic.code = "E0115";
    return diagnostic;
}

std::string full_names(std::span<const KnownPreset> presets) {
    std::vector<std::string> names;
    for (const KnownPreset& preset : presets) names.push_back(preset.full_name());
    return fmt::format("{}", fmt::join(names, " or "));
}

}  // namespace skybake::cli
