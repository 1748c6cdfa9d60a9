#include "config/presets/presets.h"

#include <algorithm>
#include <array>

namespace skybake::config {
namespace {

constexpr std::array kinds = {
    SectionPresets{"noise", "noise", noise_presets},
    SectionPresets{"clouds", "cloud", cloud_presets},
    SectionPresets{"particles", "particles", particle_presets},
    SectionPresets{"atmosphere.layers", "layer", layer_presets},
};

// Whether a cloud is much wider than tall. The cells of its noise must still be as tall as they are
// wide.
bool is_layer(std::string_view cloud) {
    constexpr std::array<std::string_view, 5> layers = {"altocumulus", "cirrus", "fog_bank",
                                                        "stratocumulus", "stratus"};
    return std::ranges::find(layers, cloud) != layers.end();
}

}  // namespace

std::span<const SectionPresets> section_presets() { return kinds; }

const Preset* find_preset(std::span<const Preset> all, std::string_view name) {
    const auto found = std::ranges::find(all, name, &Preset::name);
    return found == all.end() ? nullptr : &*found;
}

const Preset* find_preset(std::string_view name) { return find_preset(presets(), name); }

CloudNoisePreset noise_of_cloud_preset(std::string_view cloud, std::string_view noise) {
    const auto find = [](std::string_view name) { return find_preset(noise_presets(), name); };
    if (const Preset* own = find(cloud)) return {own, "none"};
    if (const Preset* named = find(noise)) return {named, "none"};
    if (noise == "shape" && is_layer(cloud)) return {find("nubis_layer"), "shape"};
    return {find("nubis_" + std::string(noise)), noise == "detail" ? "detail" : "shape"};
}

const SectionPresets* find_section_presets(std::string_view name) {
    for (const SectionPresets& kind : kinds) {
        if (find_preset(kind.all(), name)) return &kind;
    }
    return nullptr;
}

std::vector<std::string_view> preset_names(std::span<const Preset> all) {
    std::vector<std::string_view> names;
    for (const Preset& preset : all) names.push_back(preset.name);
    return names;
}

std::vector<std::string_view> preset_names() { return preset_names(presets()); }

std::string preset_comment(const Preset& preset) {
    std::string comment;
    std::string_view text = preset.text;
    while (text.starts_with('#')) {
        text.remove_prefix(text.starts_with("# ") ? 2 : 1);
        const std::size_t end = std::min(text.find('\n'), text.size());
        comment += std::string(text.substr(0, end)) + '\n';
        text.remove_prefix(std::min(end + 1, text.size()));
    }
    return comment;
}

std::string preset_title(const Preset& preset) {
    const std::string comment = preset_comment(preset);
    return comment.substr(0, comment.find('\n'));
}

}  // namespace skybake::config
