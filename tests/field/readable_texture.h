// Images as textures, for tests of probes.
#pragma once

#include <algorithm>
#include <array>

#include "bakers/field/image.h"
#include "bakers/field/wrong_lookups.h"

namespace skybake::testing {

// Makes an image readable as a texture with clamped axes. The image must outlive the result.
inline ReadableTexture readable_texture(const Image2<float>& image) {
    ReadableTexture texture;
    texture.use.size = {image.width, image.height, 1};
    texture.channels = static_cast<std::size_t>(image.channels);
    texture.read = [&image](const std::array<VoxelTap, 8>& taps, float* values) {
        for (const VoxelTap& tap : taps) {
            values = std::copy_n(image.texel(tap.voxel[0], tap.voxel[1]), image.channels, values);
        }
    };
    return texture;
}

}  // namespace skybake::testing
