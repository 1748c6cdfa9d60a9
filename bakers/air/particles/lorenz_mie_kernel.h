// The light that spheres scatter by angle, for many spheres and angles at once:
//
//   S_1 = sum c_n (a_n pi_n + b_n tau_n),  S_2 = sum c_n (a_n tau_n + b_n pi_n),
//   c_n = (2 n + 1) / (n (n + 1)),   pi_n = P_n^1 / sin theta,   tau_n = dP_n^1 / d theta
//
// (Bohren & Huffman 1983, 4.74). |S_1|^2 is of light polarised perpendicular to the plane of
// scattering, |S_2|^2 parallel to it; dC_sca/dOmega = (|S_1|^2 + |S_2|^2) / (2 k^2), k = 2 pi /
// lambda.
//
// S_1 +- S_2 = sum c_n (a_n +- b_n) (pi_n +- tau_n), and since pi_n +- tau_n at 180 degrees - theta
// are (-1)^(n+1) (pi_n -+ tau_n) at theta, two sums give two angles.
//
// pi_n comes from its differences, with 1 - cos theta in place of the cosine, so that no digits are
// lost about 0 and 180 degrees (Reinsch's way with Clenshaw's recurrence). The sums run in the
// order of n and without fused operations: the same bits for every instruction set.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "bakers/air/particles/lorenz_mie.h"

namespace skybake {

// c_n (a_n + b_n) and c_n (a_n - b_n), real and imaginary, n = 1 ...
using MieTerms = std::vector<std::array<double, 4>>;

MieTerms mie_terms(const MieCoefficients& coefficients);

// What adds up over spheres, at the angles theta and at 180 degrees - theta.
struct MieIntensities {
    std::vector<double> perpendicular, parallel;            // |S_1|^2, |S_2|^2 at theta
    std::vector<double> back_perpendicular, back_parallel;  // at 180 degrees - theta
};

// Adds the intensities of all spheres, times their weights, in their order.
//
// one_minus_cosines, 1 - cos theta in [0, 1], and the four arrays of `sums` have one length.
void add_mie_intensities(std::span<const MieTerms> spheres, std::span<const double> weights,
                         const std::vector<double>& one_minus_cosines, int threads,
                         MieIntensities& sums);

// Zeros for so many angles.
MieIntensities no_intensities(std::size_t angles);

}  // namespace skybake
