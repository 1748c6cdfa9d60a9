// The CIE 1931 standard observer of 2 degrees: how strongly light of a wavelength is seen as X, Y,
// Z.
#pragma once

#include <glm/ext/vector_double3.hpp>

namespace skybake {

constexpr double kShortestVisible_nm = 360;
constexpr double kLongestVisible_nm = 830;

// Returns (xbar, ybar, zbar), CIE's table at 5 nm interpolated linearly. For smooth spectra
// integrals are those of the 1-nm table within 1e-4. It is 0 outside 360 to 830 nm.
glm::dvec3 color_matching(double wavelength_nm);

// Lumens per watt of light at which ybar is 1 (540 THz).
constexpr double kLuminousEfficacy_lm_per_W = 683.0;

}  // namespace skybake
