// This header gives access to the presets that are built into the program: the texts of
// config/presets/*.toml and of the folders noise/, clouds/, particles/ and layers/ beside them.
// They are put into the binary when it is built, so that an installed skybake needs no data folder.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace skybake::config {

struct Preset {
    std::string_view name;  // "earth"
    std::string_view text;  // the whole recipe, with its [bake.*] sections
};

// Returns all presets of recipes, sorted by name.
std::span<const Preset> presets();

// These return the presets of noises, clouds, particles and layers, sorted by name. Each text holds
// the keys of one [noise.NAME], [clouds.NAME], [particles.NAME] or [atmosphere.layers.NAME].
std::span<const Preset> noise_presets();
std::span<const Preset> cloud_presets();
std::span<const Preset> particle_presets();
std::span<const Preset> layer_presets();

// These are the presets of one kind of section that the user names.
struct SectionPresets {
    std::string_view section;  // "noise", "atmosphere.layers"
    std::string_view noun;     // "noise", "cloud", "particles", "layer"
    std::span<const Preset> (*all)();
};
std::span<const SectionPresets> section_presets();

// These return null if there is no preset of that name.
const Preset* find_preset(std::span<const Preset> all, std::string_view name);
const Preset* find_preset(std::string_view name);

// This is the noise preset that goes with a cloud preset's noise of a given name. It is the noise
// preset of the cloud's own name, or of the noise's name, or nubis_layer for the shape
// of a cloud that is a layer, or else nubis_NAME. `pack` says how its channels are merged into the
// one of a cloud that holds a density. `preset` is null if there is none.
struct CloudNoisePreset {
    const Preset* preset = nullptr;
    std::string_view pack;  // "shape", "detail" or "none"
};
CloudNoisePreset noise_of_cloud_preset(std::string_view cloud, std::string_view noise);

// Returns the first kind of section that has a preset of that name, or null if there is none.
const SectionPresets* find_section_presets(std::string_view name);

std::vector<std::string_view> preset_names(std::span<const Preset> all);
std::vector<std::string_view> preset_names();

// Returns the comment at the preset's head without its `#`. Paragraphs have an empty line between them.
std::string preset_comment(const Preset& preset);

// Returns the first line of that comment.
std::string preset_title(const Preset& preset);

}  // namespace skybake::config
