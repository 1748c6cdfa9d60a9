// How the light at a point is kept: its moments over directions.
//
// Directions are taken at the point, z up and the sun's azimuth 0; the light is the same for an
// azimuth and its negative, so cosines suffice. With the real, orthonormal spherical harmonics
//
//   Y_lm(mu, phi) = n_lm P_l^m(mu) cos(m phi)      integral over directions of Y Y' = 1 or 0
//
// the moments are L_lm = integral of L Y_lm, and a phase function with Legendre moments chi_l
// scatters towards a direction
//
//   integral of p L = sum over l of chi_l sum over m of L_lm Y_lm(direction)
//
// exactly if L's or p's moments beyond the degree are 0. L_00 = sqrt(4 pi) times the mean radiance.
#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

namespace skybake {

// Moments are stored by rising l, and in it by rising m.
inline int moment_count(int degree) { return (degree + 1) * (degree + 2) / 2; }
inline int moment_index(int l, int m) { return l * (l + 1) / 2 + m; }

// n_lm P_l^m(mu) for a direction with this cosine, by index, without the azimuth's cos(m phi).
// `values` has room for moment_count(degree).
void zenith_harmonics(int degree, double mu, double* values);

// The same over sin^m of the zenith angle: smooth in the vertical.
void harmonics_over_sines(int degree, double mu, double* values);

// n_lm = sqrt((2 - [m = 0]) (2 l + 1) / 4pi (l - m)! / (l + m)!).
double harmonic_norm(int l, int m);

}  // namespace skybake
