// How the voxels of a volume are grouped into the cells of an occupancy grid.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

namespace skybake::occupancy {

// Voxels or cells first ... last - 1 of an axis.
struct Span {
    int first = 0;
    int last = 0;
    int count() const { return last - first; }
};

// In voxel units voxel i of an axis has its centre at i + 1/2 and cell k of edge c lies over
// [k c, min((k + 1) c, N)]: the last cell is smaller where c does not divide N. Volumes tile along
// x and y and are clamped along z, the height.
struct CellGrid {
    std::array<int, 3> voxels{};  // N along x, y, z
    int cell = 1;                 // c: 1, 2, 4, 8 or 16

    std::array<int, 3> size() const {
        std::array<int, 3> cells{};
        for (std::size_t a = 0; a < 3; ++a) cells[a] = (voxels[a] + cell - 1) / cell;
        return cells;
    }
    // The voxels of cells `cells` of an axis.
    Span voxels_of(std::size_t axis, Span cells) const {
        return {cells.first * cell, std::min(cells.last * cell, voxels[axis])};
    }
    Span voxels_of(std::size_t axis, int k) const { return voxels_of(axis, Span{k, k + 1}); }
};

inline std::size_t count_of(const std::array<int, 3>& size) {
    return static_cast<std::size_t>(size[0]) * static_cast<std::size_t>(size[1]) *
           static_cast<std::size_t>(size[2]);
}

// Where (x, y, z) is in an array of `size`, x fastest.
inline std::size_t index_of(const std::array<int, 3>& size, int x, int y, int z) {
    return (static_cast<std::size_t>(z) * static_cast<std::size_t>(size[1]) +
            static_cast<std::size_t>(y)) *
               static_cast<std::size_t>(size[0]) +
           static_cast<std::size_t>(x);
}

// The voxel that a lookup finds at index `i` of an axis: of the next tile where it repeats, else
// the last one.
inline int wrapped(int i, int size) { return ((i % size) + size) % size; }
inline int clamped(int i, int size) { return std::clamp(i, 0, size - 1); }

}  // namespace skybake::occupancy
