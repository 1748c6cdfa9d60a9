// Scattering of a plane wave by a homogeneous sphere, and sums over many spheres: Lorenz 1890, Mie
// 1908, in the notation and with the signs of Bohren & Huffman 1983, chapter 4 (time as e^(-i w t),
// so that k >= 0 absorbs).
//
//   x = 2 pi r / lambda   size parameter
//   m = n + i k           refractive index of the sphere relative to what surrounds it
//
//   a_n = ((D_n / m + n/x) psi_n - psi_(n-1)) / ((D_n / m + n/x) xi_n - xi_(n-1))
//   b_n = ((m D_n   + n/x) psi_n - psi_(n-1)) / ((m D_n   + n/x) xi_n - xi_(n-1))
//
// with the Riccati-Bessel functions psi and chi of x, xi = psi - i chi, and
// D_n = psi_n'(m x) / psi_n(m x).
//
// The hard cases and how each is handled; each has a test of its name in lorenz_mie_test.cpp:
//
//   tiny spheres        Upwards, psi_n comes from differences of almost equal numbers. Beyond n = x
//                       its ratios come from downwards instead; a_n and b_n then are accurate at
//                       any x > 0 without the series of powers of x
//   huge spheres        10^5 steps and more of a recurrence. psi goes upwards where it oscillates
//                       (n < x), chi upwards and D downwards everywhere: errors add up, none is
//                       magnified
//   strong absorption   psi_n(m x) overflows; its logarithmic derivative does not
//   weak absorption     Q_ext - Q_sca cancels. What is absorbed is a sum of its own, of positive
//                       terms: with A for D_n / m or m D_n, the Wronskian of psi and chi gives
//                       Re a_n - |a_n|^2 = -Im A / |(A + n/x) xi_n - xi_(n-1)|^2
//   m near 1            the numerators cancel: relative errors of 1e-15 / |m - 1|, the least that
//                       an m known to 1e-16 allows
//   resonances          widths below 1e-16 x are missed, as is their share in any average
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace skybake {

// Complex arithmetic that gives the same bits with every compiler: the products and quotients of
// std::complex are the run-time library's, and differ between libgcc's and compiler-rt's.
struct ComplexNumber {
    double real = 0;
    double imaginary = 0;
};

inline ComplexNumber operator*(double a, ComplexNumber b) { return {a * b.real, a * b.imaginary}; }
inline ComplexNumber conjugate(ComplexNumber a) { return {a.real, -a.imaginary}; }
inline double squared_modulus(ComplexNumber a) {
    return a.real * a.real + a.imaginary * a.imaginary;
}
// Returns 1 / a. |a|^2 must neither overflow nor underflow.
inline ComplexNumber inverse(ComplexNumber a) { return (1 / squared_modulus(a)) * conjugate(a); }

// --- One sphere ----------------------------------------------------------------------------------

// Returns the number of terms in the series of a sphere.
int mie_term_count(double size_parameter);

// Where the recurrences of a sphere begin and end.
struct MieSteps {
    int count = 0;            // terms
    int upward = 0;           // psi goes upwards to this n
    int start_of_ratios = 0;  // psi_(n-1) / psi_n goes downwards from here
    int start_of_slopes = 0;  // so does D_n
};
MieSteps mie_steps(double size_parameter, ComplexNumber refractive_index);

// Cross-sections per area pi r^2 of the sphere.
struct MieEfficiencies {
    double extinction = 0;  // scattering + absorption: never below scattering
    double scattering = 0;
    double absorption = 0;
    double mean_cosine = 0;  // of the scattering angle, "g"
};

// --- Many spheres and angles ---------------------------------------------------------------------

// The light that spheres scatter by angle, for many spheres and angles at once:
//
//   S_1 = sum c_n (a_n pi_n + b_n tau_n),  S_2 = sum c_n (a_n tau_n + b_n pi_n),
//   c_n = (2 n + 1) / (n (n + 1)),   pi_n = P_n^1 / sin theta,   tau_n = dP_n^1 / d theta
//
// (Bohren & Huffman 1983, 4.74). |S_1|^2 belongs to light polarised perpendicular to the plane of
// scattering, |S_2|^2 to light polarised parallel to it; dC_sca/dOmega = (|S_1|^2 + |S_2|^2) /
// (2 k^2) with k = 2 pi / lambda.
//
// S_1 +- S_2 = sum c_n (a_n +- b_n) (pi_n +- tau_n), and since pi_n +- tau_n at 180 degrees - theta
// are (-1)^(n+1) (pi_n -+ tau_n) at theta, two sums give two angles. If a_n - b_n and pi_n - tau_n
// both have the other sign for even n, the four products of a term keep or get the signs that they
// need, and all terms are alike.
//
// pi_n is computed from its differences, with 1 - cos theta in place of the cosine, so that no
// digits are lost near 0 and 180 degrees (Reinsch's modification of Clenshaw's recurrence). The
// sums run in the order of n and without fused operations, which gives the same bits for every
// instruction set.

// The terms of one sphere: the real and imaginary parts of c_n (a_n + b_n) and, with a minus for
// even n, of c_n (a_n - b_n), for n = 1 and on.
using MieTerms = std::vector<std::array<double, 4>>;

// Computes the terms and the efficiencies of many spheres at once: the same bits as for each by itself. Spheres
// of like size should be neighbours. All spans have the same length.
void mie_series(std::span<const double> size_parameters, ComplexNumber refractive_index,
                std::span<MieTerms> terms, std::span<MieEfficiencies> efficiencies);

// The quantities that add up over spheres, at the angles theta and at 180 degrees - theta.
struct MieIntensities {
    std::vector<double> perpendicular, parallel;            // |S_1|^2, |S_2|^2 at theta
    std::vector<double> back_perpendicular, back_parallel;  // at 180 degrees - theta
};

// Adds the intensities of all spheres, multiplied by their weights, in the order of the spheres.
//
// one_minus_cosines holds 1 - cos theta in [0, 1]. It and the four arrays of `sums` have the same
// length; `spheres` and `weights` have the same length.
void add_mie_intensities(std::span<const MieTerms> spheres, std::span<const double> weights,
                         const std::vector<double>& one_minus_cosines, int threads,
                         MieIntensities& sums);

// Returns intensities of zero at `angles` angles.
MieIntensities no_intensities(std::size_t angles);

}  // namespace skybake
