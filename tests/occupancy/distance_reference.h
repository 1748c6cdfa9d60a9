// Distances by comparing a place with every voxel: slow and obviously right.
#pragma once

#include <algorithm>
#include <array>
#include <limits>

#include "tests/occupancy/volumes_in_memory.h"

namespace skybake::test {

using Edges = std::array<double, 3>;

// A cell between eight voxel centres. Along z the first and the last one are halves.
inline std::array<std::array<double, 2>, 3> box_of_cell(const Volume& volume, int x, int y, int z) {
    const double top = volume.grid.voxels[2];
    return {
        {{x + 0.5, x + 1.5}, {y + 0.5, y + 1.5}, {std::max(z - 0.5, 0.0), std::min(z + 0.5, top)}}};
}

// How many of the eight corners of a cell are above the threshold, of 8.
inline int corners_above(const Volume& volume, int x, int y, int z, float threshold) {
    const std::array<int, 3>& size = volume.grid.voxels;
    int count = 0;
    for (int i = 0; i < 8; ++i) {
        const int cx = (x + i % 2) % size[0];
        const int cy = (y + i / 2 % 2) % size[1];
        const int cz = std::clamp(z - 1 + i / 4, 0, size[2] - 1);
        count += volume.at(cx, cy, cz) > threshold ? 1 : 0;
    }
    return count;
}

// The squared distance in m^2 from a place in voxels to the nearest cell with a corner above the
// threshold, or with one that is not, in this tile and those around it. Each square is rounded to
// float as the transform's are.
inline float least_square(const Volume& volume, const Edges& voxel_m,
                          const std::array<double, 3>& place, float threshold, bool above) {
    const std::array<int, 3>& size = volume.grid.voxels;
    float least = std::numeric_limits<float>::infinity();
    for (int z = 0; z <= size[2]; ++z) {
        for (int y = 0; y < size[1]; ++y) {
            for (int x = 0; x < size[0]; ++x) {
                const int corners = corners_above(volume, x, y, z, threshold);
                if (above ? corners == 0 : corners == 8) continue;
                const auto box = box_of_cell(volume, x, y, z);
                std::array<float, 3> squares{};
                for (std::size_t a = 0; a < 3; ++a) {
                    double way = std::numeric_limits<double>::infinity();
                    for (const int tile : {-1, 0, 1}) {
                        if (a == 2 && tile != 0) continue;
                        const double at = place[a] - tile * size[a];
                        way = std::min(way, std::max({0.0, box[a][0] - at, at - box[a][1]}));
                    }
                    const float metres =
                        static_cast<float>(2 * way) * static_cast<float>(voxel_m[a] / 2);
                    squares[a] = metres * metres;
                }
                least = std::min(least, squares[2] + (squares[1] + squares[0]));
            }
        }
    }
    if (!above) {
        const double outside = std::max(0.0, std::min(place[2], size[2] - place[2])) * voxel_m[2];
        least = std::min(least, static_cast<float>(outside * outside));
    }
    return least;
}

}  // namespace skybake::test
