#include "config/presets.h"

namespace skybake::config {
namespace {

const Preset* find_in(std::span<const Preset> all, std::string_view name) {
    for (const Preset& preset : all) {
        if (preset.name == name) return &preset;
    }
    return nullptr;
}

std::vector<std::string_view> names_of(std::span<const Preset> all) {
    std::vector<std::string_view> names;
    for (const Preset& preset : all) names.push_back(preset.name);
    return names;
}

}  // namespace

const Preset* find_preset(std::string_view name) { return find_in(presets(), name); }

std::vector<std::string_view> preset_names() { return names_of(presets()); }

const Preset* find_noise_preset(std::string_view name) { return find_in(noise_presets(), name); }

std::vector<std::string_view> noise_preset_names() { return names_of(noise_presets()); }

std::string preset_title(const Preset& preset) {
    std::string_view line = preset.text.substr(0, preset.text.find('\n'));
    while (!line.empty() && (line.front() == '#' || line.front() == ' ')) line.remove_prefix(1);
    return std::string(line);
}

}  // namespace skybake::config
