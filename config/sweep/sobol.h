// Sobol's low-discrepancy sequence.
#pragma once

#include <cstdint>

namespace skybake::config {

inline constexpr int sobol_dimensions = 16;

// Returns the coordinate of a point of Sobol's low-discrepancy sequence along a dimension. It lies
// in [0, 1) and is a multiple of 2^-32. The first n points cover a box of many dimensions evenly,
// for any n. Points and dimensions count from 0, and point 0 is the origin. Any 2^k consecutive
// points whose first index is a multiple of 2^k have one coordinate in each of the 2^k equal parts
// of [0, 1). The points are not scrambled: point i is the same however many points there are.
//
// The method is from I. M. Sobol, "On the distribution of points in a cube and the approximate
// evaluation of integrals", 1967. The direction numbers are from S. Joe and F. Y. Kuo,
// "Constructing Sobol sequences with better two-dimensional projections", SIAM J. Sci. Comput. 30,
// 2008. Their authors publish them under a BSD-style licence (sobol.cpp).
double sobol_coordinate(std::uint32_t index, int dimension);

// Returns the 32 bits after the point of a coordinate, of the points in their natural order: any 2^k
// points that follow a multiple of 2^k are those of sobol_coordinate, in another order. They are
// what scrambling begins with.
std::uint32_t sobol_bits(std::uint32_t index, int dimension);

// Returns those bits of the point 2^bit. Those of any other point are the sum without carry of the
// directions of the bits of its index.
std::uint32_t sobol_direction(int bit, int dimension);

}  // namespace skybake::config
