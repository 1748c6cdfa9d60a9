// The vector kernel of distance_transform, which finds the least sums along one axis of columns side
// by side.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "bakers/math/memory.h"

namespace skybake::occupancy {

// The cells and the points of an axis, in units of half a voxel, in which voxel centres are odd.
class EnvelopeAxis {
  public:
    // An axis of so many voxels of `voxel_m` metres, and points in the middle of every `cell` voxels.
    // One that repeats has as many cells as voxels, else there is one more, which begins at 0.
    EnvelopeAxis(int voxels, int cell, double voxel_m, bool repeats);

    int cells() const { return cells_; }
    int points() const { return points_; }
    bool repeats() const { return repeats_; }
    int centre(int point) const { return (2 * point + 1) * cell_; }
    // Returns the squared distance in m^2 from a point to a cell. Cells of an axis that repeats may
    // lie in the tiles beside it.
    float square(int point, int k) const { return of(half_voxels(centre(point), k)); }
    // Returns the square of a number of half voxels, at most 4 * voxels + 64.
    float of(int half_voxels) const { return squares_[static_cast<std::size_t>(half_voxels)]; }

  private:
    int half_voxels(int at, int k) const {
        const int low = repeats_ ? 2 * k + 1 : std::max(2 * k - 1, 0);
        const int high = repeats_ ? 2 * k + 3 : std::min(2 * k + 1, end_);
        return std::max({0, low - at, at - high});
    }

    int cells_;
    int points_;
    int cell_;
    bool repeats_;
    int end_;  // of an axis that does not repeat
    std::vector<float> squares_;
};

// As many columns are searched together, whatever the width of vectors, so that this does not change
// a bit.
inline constexpr std::size_t kColumns = 16;

// The range of the columns' best cells among the points that have been searched.
struct BestCells {
    int least = 0;
    int most = 0;
};

// The least and the greatest of all values of the columns.
struct ColumnRange {
    float least = 0;
    float most = 0;
};

// Buffers that are reused from call to call.
struct EnvelopeScratch {
    explicit EnvelopeScratch(const EnvelopeAxis& axis)
        : rows(static_cast<std::size_t>(axis.cells()) * kColumns),
          best(static_cast<std::size_t>(axis.points())) {}

    AlignedFloats rows;
    std::vector<BestCells> best;
};

// For each point p of the axis, out[p * out_stride + c] = min over k of axis.square(p, k) +
// in[k * in_stride + c], for kColumns columns c. No value is negative or NaN; infinite ones are no
// cells.
void least_sums(const float* in, std::size_t in_stride, const EnvelopeAxis& axis,
                EnvelopeScratch& scratch, float* out, std::size_t out_stride);

}  // namespace skybake::occupancy
