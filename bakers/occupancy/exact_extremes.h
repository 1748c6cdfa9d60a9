// The extremes of the trilinear filter over one cell where double is not wide enough for them.
#pragma once

#include <bit>
#include <cstdint>

#include "bakers/occupancy/cell_row_kernel.h"

namespace skybake::occupancy {

// The extremes over cell `k` of a bundle, rounded outwards, from those that trilinear_row found in
// double, whose sums may have been rounded. Exact for any finite floats.
struct CellExtremes {
    float least = 0;
    float most = 0;
};
CellExtremes exact_extremes(const RowBundle& bundle, int k, double least, double most);

// From double to the nearest float that is not on the wrong side.

// The least float >= value, 0 without a sign. The value is within the range of floats. Without a
// branch, as every other value is rounded.
inline float rounded_up(double value) {
    const auto nearest = static_cast<float>(value);
    const auto bits = std::bit_cast<std::int32_t>(nearest);
    // Upwards the bits of a negative float fall. -0 is never below a value that rounds to it.
    const std::int32_t step = (bits >> 31) | 1;
    const std::int32_t below = double{nearest} < value ? 1 : 0;
    return std::bit_cast<float>(bits + step * below) + 0.0F;
}

// The greatest float <= value.
inline float rounded_down(double value) { return -rounded_up(-value) + 0.0F; }

}  // namespace skybake::occupancy
