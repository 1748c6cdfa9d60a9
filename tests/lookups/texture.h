// The texels of baked assets as a runtime holds them, filtered in double.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "bakers/field/baked.h"
#include "bakers/field/interpolation.h"
#include "bakers/field/pixel_type.h"
#include "tests/support/volumes.h"

namespace skybake {

struct Texture {
    std::array<int, 3> size{1, 1, 1};
    int channels = 0;
    std::vector<float> texels;  // x fastest, then y, then z, channels interleaved
    std::array<bool, 3> repeats{};
    mutable long lookups = 0;  // how often it was asked
    std::string name{};        // of the file that it is from

    float texel(const std::array<int, 3>& at, int channel) const {
        const auto row = static_cast<std::size_t>(at[2] * size[1] + at[1]);
        const auto index =
            row * static_cast<std::size_t>(size[0]) + static_cast<std::size_t>(at[0]);
        return texels[index * static_cast<std::size_t>(channels) +
                      static_cast<std::size_t>(channel)];
    }
};

// Fetches as GL does: absent colours are 0, absent alpha is 1.
inline std::array<double, 4> fetched(const Texture& texture, const std::array<int, 3>& at) {
    ++texture.lookups;
    std::array<double, 4> value{0, 0, 0, 1};
    for (int c = 0; c < texture.channels; ++c) {
        value[static_cast<std::size_t>(c)] = double{texture.texel(at, c)};
    }
    return value;
}

inline std::array<double, 4> filtered(const Texture& texture, const std::array<double, 3>& uvw) {
    ++texture.lookups;
    if (!std::isfinite(uvw[0] + uvw[1] + uvw[2])) return {NAN, NAN, NAN, NAN};
    std::array<double, 4> value{0, 0, 0, texture.channels == 4 ? 0.0 : 1.0};
    for (const VoxelTap& tap : trilinear_taps(texture.size, uvw, texture.repeats)) {
        if (tap.weight == 0) continue;
        for (int c = 0; c < texture.channels; ++c) {
            value[static_cast<std::size_t>(c)] += tap.weight * double{texture.texel(tap.voxel, c)};
        }
    }
    return value;
}

// Returns level 0 as a texture, rounded as a file stores it.
inline Texture texture_of(const Baked& baked) {
    const Level& level = baked.levels.front();
    const auto values =
        testing::planes_of(*level.voxels, {{}, level.size}, baked.channel_names.size());
    Texture texture;
    texture.size = level.size;
    texture.channels = static_cast<int>(values.size());
    texture.repeats = level.repeats;
    for (std::size_t i = 0; i < values[0].size(); ++i) {
        for (const std::vector<float>& channel : values) {
            texture.texels.push_back(round_to_pixel_type(double{channel[i]}, baked.pixel_type));
        }
    }
    return texture;
}

}  // namespace skybake
