// Scattering of a plane wave by a homogeneous sphere: Lorenz 1890, Mie 1908, in the notation and
// with the signs of Bohren & Huffman 1983, chapter 4 (time as e^(-i w t), so that k >= 0 absorbs).
//
//   x = 2 pi r / lambda   size parameter
//   m = n + i k           refractive index of the sphere relative to what surrounds it
//
//   a_n = ((D_n / m + n/x) psi_n - psi_(n-1)) / ((D_n / m + n/x) xi_n - xi_(n-1))
//   b_n = ((m D_n   + n/x) psi_n - psi_(n-1)) / ((m D_n   + n/x) xi_n - xi_(n-1))
//
// with the Riccati-Bessel functions psi, chi of x, xi = psi - i chi, and D_n = psi_n'(m x) /
// psi_n(m x).
//
// The hard cases, each with a test of its name in lorenz_mie_test.cpp, and what is done about it:
//
//   tiny spheres        Upwards, psi_n comes from differences of almost equal numbers. Beyond n = x
//                       its ratios come from downwards instead; a_n and b_n then are accurate at
//                       any x > 0 without the series of powers of x
//   huge spheres        10^5 steps and more of a recurrence. psi goes upwards where it oscillates
//   (n < x),
//                       chi upwards and D downwards everywhere: errors add up, none is magnified
//   strong absorption   psi_n(m x) overflows; its logarithmic derivative does not
//   weak absorption     Q_ext - Q_sca cancels. What is absorbed is a sum of its own, of positive
//                       terms: with A for D_n / m or m D_n, the Wronskian of psi and chi gives
//                       Re a_n - |a_n|^2 = -Im A / |(A + n/x) xi_n - xi_(n-1)|^2
//   m near 1            the numerators cancel: relative errors of 1e-15 / |m - 1|, the least that
//                       an m known to 1e-16 allows
//   resonances          widths below 1e-16 x are missed, as is their share in any average
#pragma once

#include <vector>

#include "bakers/air/particles/complex_number.h"

namespace skybake {

struct MieCoefficients {
    double size_parameter = 0;
    std::vector<ComplexNumber> a, b;   // a_1 ..., b_1 ...
    double absorption_efficiency = 0;  // Q_abs
};

// How many terms the series of a sphere has.
int mie_term_count(double size_parameter);

// For 1e-8 <= x <= 3e5, 0.01 <= |m| <= 150. Time and memory grow as max(1, |m|) x.
MieCoefficients mie_coefficients(double size_parameter, ComplexNumber refractive_index);

// Cross-sections per area pi r^2 of the sphere.
struct MieEfficiencies {
    double extinction = 0;  // scattering + absorption: never below scattering
    double scattering = 0;
    double absorption = 0;
    double backscatter = 0;  // 4 pi dC_sca/dOmega at 180 degrees, radar's
    double mean_cosine = 0;  // of the scattering angle, "g"
};

MieEfficiencies mie_efficiencies(const MieCoefficients& coefficients);

}  // namespace skybake
