// The presets that travel inside the program: the texts of config/presets/*.toml, and of the
// folders noise/, clouds/, particles/ and layers/ beside them, put into the binary when it is
// built, so that an installed skybake needs no data folder.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace skybake::config {

struct Preset {
    std::string_view name;  // "earth"
    std::string_view text;  // the whole recipe, [bake.*] sections included
};

// All presets of recipes, by name.
std::span<const Preset> presets();

// Those of noises, of clouds, of particles and of layers, by name; their texts are the keys of one
// [noise.NAME], [clouds.NAME], [particles.NAME] or [atmosphere.layers.NAME].
std::span<const Preset> noise_presets();
std::span<const Preset> cloud_presets();
std::span<const Preset> particle_presets();
std::span<const Preset> layer_presets();

// Presets of sections that the user names.
struct SectionPresets {
    std::string_view section;  // "noise", "atmosphere.layers"
    std::string_view noun;     // "noise", "cloud", "particles", "layer"
    std::span<const Preset> (*all)();
};
std::span<const SectionPresets> section_presets();

// Null if there is none of that name.
const Preset* find_preset(std::span<const Preset> all, std::string_view name);
const Preset* find_preset(std::string_view name);
const Preset* find_noise_preset(std::string_view name);
const Preset* find_cloud_preset(std::string_view name);

// What goes with the cloud preset's noise of that name: the noise preset of the cloud's own name,
// or nubis_layer for the shape of a cloud that is a layer, or else nubis_NAME; merged into one
// channel where the cloud holds a density. A preset of null if there is none.
struct CloudNoisePreset {
    const Preset* preset = nullptr;
    std::string_view pack;  // "shape", "detail" or "none"
};
CloudNoisePreset noise_of_cloud_preset(std::string_view cloud, std::string_view noise);

// The first kind of section that has a preset of that name; null if there is none.
const SectionPresets* find_section_presets(std::string_view name);

std::vector<std::string_view> preset_names(std::span<const Preset> all);
std::vector<std::string_view> preset_names();
std::vector<std::string_view> noise_preset_names();
std::vector<std::string_view> cloud_preset_names();
std::vector<std::string_view> particle_preset_names();
std::vector<std::string_view> layer_preset_names();

// The first line of the comment at the preset's head.
std::string preset_title(const Preset& preset);

}  // namespace skybake::config
