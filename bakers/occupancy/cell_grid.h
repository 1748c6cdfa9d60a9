// The grouping of a volume's voxels into the cells of an occupancy grid, and the filters by which
// runtimes look voxels up.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

#include "bakers/math/wrapped.h"

namespace skybake::config {
enum class OccupancyFilter;
}

namespace skybake::occupancy {

// The voxels or cells from first to last - 1 of an axis.
struct Span {
    int first = 0;
    int last = 0;
    int count() const { return last - first; }
};

// In voxel units voxel i of an axis has its centre at i + 1/2, and cell k of edge c covers [k c,
// min((k + 1) c, N)]: the last cell is smaller where c does not divide N. Volumes repeat along x
// and y and are clamped along z, the height.
struct CellGrid {
    std::array<int, 3> voxels{};  // N along x, y, z
    int cell = 1;                 // c: 1, 2, 4, 8 or 16

    std::array<int, 3> size() const {
        std::array<int, 3> cells{};
        for (std::size_t a = 0; a < 3; ++a) cells[a] = (voxels[a] + cell - 1) / cell;
        return cells;
    }
    // Returns the voxels that belong to the cells `cells` of an axis.
    Span voxels_of(std::size_t axis, Span cells) const {
        return {cells.first * cell, std::min(cells.last * cell, voxels[axis])};
    }
    Span voxels_of(std::size_t axis, int k) const { return voxels_of(axis, Span{k, k + 1}); }
};

inline std::size_t count_of(const std::array<int, 3>& size) {
    return static_cast<std::size_t>(size[0]) * static_cast<std::size_t>(size[1]) *
           static_cast<std::size_t>(size[2]);
}

// Returns the index of (x, y, z) in an array of `size`, x fastest.
inline std::size_t index_of(const std::array<int, 3>& size, int x, int y, int z) {
    return (static_cast<std::size_t>(z) * static_cast<std::size_t>(size[1]) +
            static_cast<std::size_t>(y)) *
               static_cast<std::size_t>(size[0]) +
           static_cast<std::size_t>(x);
}

// Return the voxel that a lookup finds at index `i` of an axis: that of the repeated tile, or the
// nearest one.
using skybake::wrapped;
inline int clamped(int i, int size) { return std::clamp(i, 0, size - 1); }

// Returns how many voxels beyond a cell's faces lookups in the cell use: 0, 1 or 2.
int voxels_beyond(config::OccupancyFilter filter);

// The voxels along one axis that a lookup uses, and their weights, which are >= 0 and sum to 1
// except for rounding.
struct AxisTaps {
    int count = 0;
    std::array<int, 4> voxel{};
    std::array<double, 4> weight{};
};

// Returns the taps at `position` in voxel units, where voxel i has its centre at i + 1/2, on an
// axis of `size` voxels that repeats or is clamped.
//   nearest    voxel floor(position)
//   trilinear  the two nearest centres
//   tricubic   the uniform B-spline over the four nearest centres, for instance Sigg & Hadwiger,
//              "Fast third-order texture filtering", GPU Gems 2, 2005
AxisTaps filter_taps(config::OccupancyFilter filter, double position, int size, bool repeats);

// Returns the filtered value in double; value(x, y, z) returns that of a voxel. Since weights are
// >= 0, rounding is 1e-15 of the greatest voxel used.
template <class Value>
double filtered_in_double(const std::array<AxisTaps, 3>& taps, const Value& value) {
    double sum = 0;
    for (std::size_t k = 0; k < static_cast<std::size_t>(taps[2].count); ++k) {
        double plane = 0;
        for (std::size_t j = 0; j < static_cast<std::size_t>(taps[1].count); ++j) {
            double row = 0;
            for (std::size_t i = 0; i < static_cast<std::size_t>(taps[0].count); ++i) {
                row += taps[0].weight[i] *
                       double{value(taps[0].voxel[i], taps[1].voxel[j], taps[2].voxel[k])};
            }
            plane += taps[1].weight[j] * row;
        }
        sum += taps[2].weight[k] * plane;
    }
    return sum;
}

// Returns the same rounded to float, as a texture unit does. The error of the double is far below
// half a unit in the float's last place, unless voxels of both signs cancel. So where the exact
// filter is not above a float, this value is not either.
template <class Value>
float filtered_value(const std::array<AxisTaps, 3>& taps, const Value& value) {
    return static_cast<float>(filtered_in_double(taps, value));
}

}  // namespace skybake::occupancy
