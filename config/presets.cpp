#include "config/presets.h"

namespace skybake::config {

const Preset* find_preset(std::string_view name) {
    for (const Preset& preset : presets()) {
        if (preset.name == name) return &preset;
    }
    return nullptr;
}

std::vector<std::string_view> preset_names() {
    std::vector<std::string_view> names;
    for (const Preset& preset : presets()) names.push_back(preset.name);
    return names;
}

std::string preset_title(const Preset& preset) {
    std::string_view line = preset.text.substr(0, preset.text.find('\n'));
    while (!line.empty() && (line.front() == '#' || line.front() == ' ')) line.remove_prefix(1);
    return std::string(line);
}

}  // namespace skybake::config
