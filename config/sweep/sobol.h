// Sobol's low-discrepancy points, which cover a box of many dimensions evenly for any first so many
// of them.
#pragma once

#include <cstdint>

namespace skybake::config {

inline constexpr int sobol_dimensions = 16;

// The coordinate of point `index` (from 0: the origin) along a dimension (from 0), in [0, 1), a
// multiple of 2^-32. Any 2^k points from a multiple of 2^k on have one coordinate in each 2^-k of
// the range. Not scrambled: point i is the same however many there are.
//
// I. M. Sobol, "On the distribution of points in a cube and the approximate evaluation of
// integrals", 1967, with the direction numbers of S. Joe and F. Y. Kuo, "Constructing Sobol
// sequences with better two-dimensional projections", SIAM J. Sci. Comput. 30, 2008, which their
// authors publish under a BSD-style licence (sobol.cpp).
double sobol_coordinate(std::uint32_t index, int dimension);

}  // namespace skybake::config
