// The CIE 1931 standard observer of 2 degrees: how strongly light of a wavelength is seen as X, Y,
// Z.
//
// The wavelengths at which observer and sun are tabulated: every 5 nm from 360 to 830 nm.
#pragma once

#include <glm/ext/vector_double3.hpp>

#include <algorithm>
#include <cstddef>

namespace skybake {

constexpr double kShortestVisible_nm = 360;
constexpr double kLongestVisible_nm = 830;

// Returns (xbar, ybar, zbar), CIE's table at 5 nm interpolated linearly. For smooth spectra
// integrals are those of the 1-nm table within 1e-4. It is 0 outside 360 to 830 nm.
glm::dvec3 color_matching(double wavelength_nm);

// Lumens per watt of light at which ybar is 1 (540 THz).
constexpr double kLuminousEfficacy_lm_per_W = 683.0;

inline constexpr double kSpectralStep_nm = 5;
inline constexpr std::size_t kSpectralNodes = 95;

constexpr double spectral_node_nm(std::size_t node) {
    return kShortestVisible_nm + kSpectralStep_nm * static_cast<double>(node);
}

constexpr bool is_visible(double wavelength_nm) {
    return wavelength_nm >= kShortestVisible_nm && wavelength_nm <= kLongestVisible_nm;
}

// Between nodes `below` and `below` + 1, `fraction` of the way.
struct SpectralPlace {
    std::size_t below = 0;
    double fraction = 0;
    constexpr double between(double first, double second) const {
        return first + (second - first) * fraction;
    }
};

// The wavelength must be visible.
constexpr SpectralPlace spectral_place(double wavelength_nm) {
    const double steps = (wavelength_nm - kShortestVisible_nm) / kSpectralStep_nm;
    const std::size_t below = std::min(static_cast<std::size_t>(steps), kSpectralNodes - 2);
    return {below, steps - static_cast<double>(below)};
}

}  // namespace skybake
