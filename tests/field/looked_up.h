// Looks up between voxels, for tests of the bakers' own lookups.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "bakers/field/pixel_type.h"
#include "tests/support/volumes.h"

namespace skybake::testing {

// A lookup of voxels as stored, from the definition: hat functions about voxel centres.
inline double looked_up(const FunctionVoxels::Function& voxel, const std::array<int, 3>& size,
                        config::PixelType type, int channel, const std::array<double, 3>& uvw) {
    const auto weight = [&](std::size_t axis, int i) {
        double sum = 0;  // of all copies of the voxel
        for (int copy = -2; copy <= 2; ++copy) {
            const double apart = uvw[axis] * size[axis] - (i + 0.5 + copy * size[axis]);
            sum += std::max(0.0, 1 - std::fabs(apart));
        }
        return sum;
    };
    double sum = 0;
    for_each_voxel(size, [&](int x, int y, int z) {
        const double w = weight(0, x) * weight(1, y) * weight(2, z);
        if (w != 0) sum += w * double{round_to_pixel_type(voxel(x, y, z, channel), type)};
    });
    return sum;
}

}  // namespace skybake::testing
