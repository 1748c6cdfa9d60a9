// Shared by the tests of noises: recipes of one noise, and a spelling that tells bakes of it apart.
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

inline std::string to_string(const AssetFiles& files) {
    std::string text =
        fmt::format("{} {} {} {} {} {}", static_cast<int>(files.pixel_type),
                    static_cast<int>(files.layout), files.columns, files.mips,
                    static_cast<int>(files.compression), static_cast<int>(files.vdb_compression));
    for (const FileFormat format : files.formats)
        text += fmt::format(" {}", static_cast<int>(format));
    return text;
}

inline std::string to_string(const NoiseVolumeBake& bake) {
    return fmt::format("{} {} ", bake.noise, bake.size) +
           to_string(static_cast<const AssetFiles&>(bake));
}

}  // namespace skybake::config::testing
