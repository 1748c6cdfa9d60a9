// Real spherical harmonics of directions, up to degree 3.
//
// Coefficient l^2 + l + m has degree l and order m = -l ... l. With a unit vector (x, y, z), z up:
//
//   Y_00 = 1 / (2 sqrt(pi))     Y_1-1, Y_10, Y_11 = sqrt(3 / (4 pi)) (y, z, x)     and so on
//
// They are orthonormal over the sphere, without the factor (-1)^m: Sloan 2008, "Stupid spherical
// harmonics (SH) tricks", appendix A2, up to that sign.
#pragma once

#include <array>
#include <vector>

#include "bakers/math/vectors.h"

namespace skybake::cloud_light {

inline constexpr int kMostDegree = 3;
inline constexpr std::size_t kMostHarmonics = (kMostDegree + 1) * (kMostDegree + 1);

using Harmonics = std::array<double, kMostHarmonics>;
Harmonics harmonics(const glm::dvec3& direction);

// The degree l of coefficient l^2 + l + m.
std::size_t degree_of_harmonic(std::size_t coefficient);

// Directions of the upper hemisphere with their solid angles: Gauss and Legendre's rule of the cosine
// of the zenith angle, and even steps of the azimuth.
struct SkyDirection {
    glm::dvec3 direction{};
    double solid_angle = 0;  // sr; their sum is 2 pi
};
std::vector<SkyDirection> sky_directions(int zenith, int around);

// The weight of a value at each direction in each coefficient.
using CoefficientWeights = std::vector<Harmonics>;

// Coefficients of the function that is 0 below the horizon: its integrals times each harmonic.
CoefficientWeights projection_weights(const std::vector<SkyDirection>& directions);

// Coefficients of the sum of harmonics, up to a degree, that is nearest to the values above the
// horizon by least squares over solid angle.
CoefficientWeights hemisphere_fit_weights(const std::vector<SkyDirection>& directions, int degree);

}  // namespace skybake::cloud_light
