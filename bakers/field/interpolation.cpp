#include "bakers/field/interpolation.h"

#include <cmath>
#include <cstddef>

namespace skybake {
namespace {

// The two voxels around a place on one axis, and the place's position between them, from 0 to 1.
struct Neighbours {
    std::array<int, 2> voxel{};
    double fraction = 0;
};

Neighbours repeated_neighbours(double coordinate, int size) {
    const double within = coordinate - std::floor(coordinate);  // [0, 1]: -1e-20 rounds to 1
    const double position = within * size - 0.5;
    const double below = std::floor(position);
    const int first = (static_cast<int>(below) + size) % size;
    return {{first, (first + 1) % size}, position - below};
}

Neighbours clamped_neighbours(double coordinate, int size) {
    const double last = size - 1;
    const double position = std::clamp(coordinate * size - 0.5, 0.0, last);
    const double below = std::floor(position);
    const int first = static_cast<int>(below);
    return {{first, std::min(first + 1, size - 1)}, position - below};
}

}  // namespace

std::array<VoxelTap, 8> trilinear_taps(const std::array<int, 3>& size,
                                       const std::array<double, 3>& uvw,
                                       const std::array<bool, 3>& repeats) {
    std::array<Neighbours, 3> axes;
    for (std::size_t a = 0; a < 3; ++a) {
        axes[a] =
            repeats[a] ? repeated_neighbours(uvw[a], size[a]) : clamped_neighbours(uvw[a], size[a]);
    }
    std::array<VoxelTap, 8> taps;
    for (std::size_t i = 0; i < 8; ++i) {
        taps[i].weight = 1;
        for (std::size_t a = 0; a < 3; ++a) {
            const std::size_t side = (i >> a) & 1U;
            taps[i].voxel[a] = axes[a].voxel[side];
            taps[i].weight *= side == 0 ? 1 - axes[a].fraction : axes[a].fraction;
        }
    }
    return taps;
}

}  // namespace skybake
