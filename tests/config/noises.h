// Shared by the tests of noises: recipes of one noise, and a spelling that tells noises apart.
#pragma once

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <string>

#include "config/assets/noise_volume.h"
#include "config/sections/noise.h"
#include "tests/config/recipes.h"

namespace skybake::config::testing {

// A recipe of the noise `n`, whose one channel Y has these keys.
inline std::string channel_recipe(const std::string& keys) {
    return "[noise.n.channels.Y]\n" + keys + "\n";
}

// The same with a bake of these keys.
inline std::string volume_recipe(const std::string& bake, const std::string& channel) {
    return "[bake.n]\nasset = 'noise_volume'\nnoise = 'n'\n" + bake + "\n" +
           channel_recipe(channel);
}

inline NoiseChannel channel_of(const std::string& keys) {
    const Recipe recipe = valid(channel_recipe(keys));
    if (recipe.parameters.noises.size() != 1) return {};
    return recipe.parameters.noises[0].channels.at(0);
}

inline std::string to_string(const NoiseOctaves& octaves) {
    return fmt::format("{} {}", octaves.frequencies, octaves.gains);
}

// Every member, so that equal texts mean equal noises.
inline std::string to_string(const NoiseChannel& channel) {
    return fmt::format("{} {} {} | {} | {} | {} {} {} {} {} {} {} {} {} {}", channel.name,
                       static_cast<int>(channel.type), channel.value, to_string(channel.octaves),
                       to_string(channel.worley_octaves), static_cast<int>(channel.fractal),
                       static_cast<int>(channel.feature), static_cast<int>(channel.value_form),
                       static_cast<int>(channel.component), channel.seed, channel.remap,
                       channel.smoothstep.value_or(std::array<double, 2>{}), channel.invert,
                       channel.bias, channel.clamp);
}

inline std::string to_string(const Noise& noise) {
    std::string text = fmt::format("{} {} {} {} {}", noise.name, noise.seed, noise.size,
                                   static_cast<int>(noise.sampling), static_cast<int>(noise.pack));
    for (const NoiseChannel& channel : noise.channels) text += "\n" + to_string(channel);
    return text;
}

inline std::string to_string(const NoiseVolumeBake& bake) {
    std::string text = fmt::format("{} {} {} {} {} {} {} {}", bake.noise, bake.size,
                                   static_cast<int>(bake.pixel_type), static_cast<int>(bake.layout),
                                   bake.columns, bake.mips, static_cast<int>(bake.compression),
                                   static_cast<int>(bake.vdb_compression));
    for (const FileFormat format : bake.formats)
        text += fmt::format(" {}", static_cast<int>(format));
    return text;
}

}  // namespace skybake::config::testing
