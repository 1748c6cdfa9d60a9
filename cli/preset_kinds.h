// The kinds of presets, as `init` writes recipes from them and messages name them.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "config/diagnostics/diagnostic.h"
#include "config/presets/presets.h"

namespace skybake::cli {

struct PresetKind {
    std::string_view name;    // "clouds": what comes before the dot of "clouds.thesis"
    std::string_view plural;  // "clouds", for lists
    std::string_view use;     // how a recipe names such a preset
    std::span<const config::Preset> (*all)();
    std::string (*recipe)(const config::Preset& preset);  // the text of init; null: not a recipe
};
std::span<const PresetKind> preset_kinds();

struct KnownPreset {
    const PresetKind* kind = nullptr;
    const config::Preset* preset = nullptr;

    std::string full_name() const;  // "clouds.thesis"
    std::string recipe() const { return kind->recipe(*preset); }
};

// Presets of that name that `init` can write: none, one, or one of each kind ("thesis"). A full
// name, "clouds.thesis", fits one.
std::vector<KnownPreset> presets_for_init(std::string_view name);

// The command that writes a recipe from the first of them: `name`, where it fits just that one, or
// its full name.
std::string init_command_of(std::span<const KnownPreset> presets, std::string_view name);

// E0115: there is no such preset, or it is one of a layer. The label names those that are meant.
config::Diagnostic unknown_preset(const std::string& name);

// "noise.thesis or clouds.thesis".
std::string full_names(std::span<const KnownPreset> presets);

}  // namespace skybake::cli
