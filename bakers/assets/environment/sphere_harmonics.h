// Real spherical harmonics to degree 4 of light around a point.
//
//   L(w) = sum over l, m of c_lm Y_lm(w),   c_lm = integral of L Y_lm over the sphere
//
// The harmonics are orthonormal, without the Condon-Shortley phase, as in Sloan 2008, "Stupid
// Spherical Harmonics Tricks", appendix A2, of (x, y, z) = (right, ahead, up): m counts azimuths
// from right to ahead. They stand in the order l (l + 1) + m.
#pragma once

#include <array>
#include <cstddef>
#include <glm/ext/vector_double3.hpp>
#include <vector>

#include "bakers/assets/environment/environment_mapping.h"
#include "bakers/field/image.h"

namespace skybake {

inline constexpr int kHarmonicDegree = 4;
inline constexpr std::size_t kHarmonics = 25;

// Returns all Y_lm at a direction (right, up, ahead).
std::array<double, kHarmonics> harmonics_at(const glm::dvec3& direction);

// Returns the coefficients of each channel of a map: [channel][l (l + 1) + m]. Each texel counts with
// its solid angle, as if all its light came from its middle.
std::vector<std::array<double, kHarmonics>> harmonics_of(const Image2<float>& map,
                                                         const EnvironmentLayout& layout);

// Returns the irradiance of a level surface, facing up, by the texels of the upper half: one value
// for each channel.
std::vector<double> level_irradiance(const Image2<float>& map, const EnvironmentLayout& layout);

}  // namespace skybake
