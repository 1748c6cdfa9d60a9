// Loops over voxels and texels in the order of files.
#pragma once

#include <array>

namespace skybake::testing {

// Calls a function of (x, y, z) for each voxel of a volume.
template <class Visit, class Size = std::array<int, 3>>
void for_each_voxel(const Size& size, const Visit& visit) {
    for (int z = 0; z < size[2]; ++z) {
        for (int y = 0; y < size[1]; ++y) {
            for (int x = 0; x < size[0]; ++x) visit(x, y, z);
        }
    }
}

// Calls a function of (x, y) for each texel of an image.
template <class Visit>
void for_each_texel(int width, int height, const Visit& visit) {
    for_each_voxel({width, height, 1}, [&](int x, int y, int) { visit(x, y); });
}

}  // namespace skybake::testing
