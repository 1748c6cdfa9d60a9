// The extremes of the trilinear filter over one cell where double has too few bits for exact sums,
// and rounding of a double to the nearest float on one side.
#pragma once

#include <bit>
#include <cstdint>

#include "bakers/occupancy/cell_row_kernel.h"

namespace skybake::occupancy {

// Returns the extremes over cell `k` of a bundle, rounded outwards. `least` and `most` are those
// that trilinear_row found in double, whose sums may have been rounded. The result is exact for any
// finite floats.
struct CellExtremes {
    float least = 0;
    float most = 0;
};
CellExtremes exact_extremes(const RowBundle& bundle, int k, double least, double most);

// Returns the least float >= value, where 0 has no sign. The value must be within the range of
// floats. There is no branch, since about every second value is rounded.
inline float rounded_up(double value) {
    const auto nearest = static_cast<float>(value);
    const auto bits = std::bit_cast<std::int32_t>(nearest);
    // Towards greater values the bits of a negative float decrease. -0 is never below a value that
    // rounds to it.
    const std::int32_t step = (bits >> 31) | 1;
    const std::int32_t below = double{nearest} < value ? 1 : 0;
    return std::bit_cast<float>(bits + step * below) + 0.0F;
}

// Returns the greatest float <= value.
inline float rounded_down(double value) { return -rounded_up(-value) + 0.0F; }

}  // namespace skybake::occupancy
