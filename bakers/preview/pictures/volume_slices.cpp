#include "bakers/preview/pictures/volume_slices.h"

#include <cstddef>

namespace skybake {

Image2<float> slice(const VoxelView& volume, int channel, int axis, int at) {
    const auto across = static_cast<std::size_t>(axis == 0 ? 1 : 0);
    const auto up = static_cast<std::size_t>(axis == 2 ? 1 : 2);
    Image2<float> plane(volume.size[across], volume.size[up], 1);
    std::array<std::size_t, 3> place{};
    place[static_cast<std::size_t>(axis)] = static_cast<std::size_t>(at);
    const auto width = static_cast<std::size_t>(volume.size[0]);
    const auto height = static_cast<std::size_t>(volume.size[1]);
    for (int row = 0; row < plane.height; ++row) {
        for (int column = 0; column < plane.width; ++column) {
            place[across] = static_cast<std::size_t>(column);
            place[up] = static_cast<std::size_t>(row);
            const std::size_t voxel = (place[2] * height + place[1]) * width + place[0];
            *plane.texel(column, row) =
                (*volume.voxels)[voxel * static_cast<std::size_t>(volume.channels) +
                                 static_cast<std::size_t>(channel)];
        }
    }
    return plane;
}

Image2<float> tiled_twice(const Image2<float>& tile) {
    Image2<float> tiled(2 * tile.width, 2 * tile.height, 1);
    for (int y = 0; y < tiled.height; ++y) {
        for (int x = 0; x < tiled.width; ++x) {
            *tiled.texel(x, y) = *tile.texel(x % tile.width, y % tile.height);
        }
    }
    return tiled;
}

}  // namespace skybake
