// The presets that travel inside the program: the texts of config/presets/*.toml and of
// config/presets/noise/*.toml, put into the binary when it is built, so that an installed skybake
// needs no data folder.
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

// All presets, by name.
std::span<const Preset> presets();

// Null if there is none of that name.
const Preset* find_preset(std::string_view name);

std::vector<std::string_view> preset_names();

// Those of noises; their texts are the keys of one [noise.NAME].
std::span<const Preset> noise_presets();
const Preset* find_noise_preset(std::string_view name);
std::vector<std::string_view> noise_preset_names();

// The first line of the comment at the preset's head.
std::string preset_title(const Preset& preset);

}  // namespace skybake::config
