// The radiance of a row in thousands of azimuths: sky_row.h at few of them, and polynomials between.
//
//   L(phi) = sum_k p_k(nu) S_k(c) + M(c) + G(c),   c = cos phi
//
// A layer's phase function p_k changes fast about the sun, and is computed at each azimuth. What
// else there is, the sunlight S_k that a layer scatters, the light M of higher orders and that of
// the ground G, are smooth functions of c, except where the planet's shadow begins. M is computed as
// sky_row.h does.
//
// The others are polynomials through Chebyshev's points of the second kind (Berrut & Trefethen 2004,
// "Barycentric Lagrange Interpolation") of a range of azimuths. A polynomial of half the degree is
// compared with the others of these points: where they differ by more than kWideRowError, the degree
// is doubled once, and the range is quartered then. A range with few azimuths has no polynomial: each
// of them is computed. So light next to the shadow, whose quadrature changes its error with every
// piece of air that the shadow's edge enters, costs hardly more than azimuth by azimuth.
#pragma once

#include <vector>

#include "bakers/light/sky_row.h"
#include "bakers/light/sky_view_mapping.h"

namespace skybake {

// Relative to max(value, 1e-3 of the largest in a range of azimuths).
inline constexpr double kWideRowError = 1e-5;

// Returns the radiance at azimuths from the sun in half turns, each in [0, 1]. `row` is of the rays of
// `view` in the air `medium`.
std::vector<SkyRadiance> wide_radiance(const SkyRow& row, const SkyMedium& medium,
                                       const RowOfView& view, const std::vector<double>& azimuths);

}  // namespace skybake
