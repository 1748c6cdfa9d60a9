// The vector kernel of stored_distance.h: distances to cloud as unorm types hold them.
#pragma once

#include <cstddef>

namespace skybake::occupancy {

// The numbers that a code is made from (DistanceCode).
struct CodeNumbers {
    double half_diagonal_m = 0;  // of a texel
    double curvature_m2 = 0;
    double arithmetic_m = 0;
    double low_m = 0;  // of the range
    double high_m = 0;
    double steps = 0;  // of the pixel type
};

inline constexpr double kCodeArithmetic = 0x1p-20;
// Half a texel's diagonal times this is how far a place 1/256 texel off along each axis is away.
inline constexpr double kCodePlace = 1.0 / 128;

// Writes DistanceCode::outside of each squared distance, bit for bit.
void code_outside(const CodeNumbers& numbers, const float* squares, std::size_t count, float* out);

}  // namespace skybake::occupancy
