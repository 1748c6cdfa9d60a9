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
#include <cstddef>

#include "bakers/math/vectors.h"

namespace skybake {

inline constexpr int kMostDegree = 3;
inline constexpr std::size_t kMostHarmonics = (kMostDegree + 1) * (kMostDegree + 1);

using Harmonics = std::array<double, kMostHarmonics>;
Harmonics harmonics(const glm::dvec3& direction);

// The degree l of coefficient l^2 + l + m.
std::size_t degree_of_harmonic(std::size_t coefficient);

}  // namespace skybake
