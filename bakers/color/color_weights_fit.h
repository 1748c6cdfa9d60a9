// Weights by which the light of a few wavelengths becomes a colour, fitted to spectra whose colours
// are known.
#pragma once

#include <glm/ext/vector_double3.hpp>
#include <span>
#include <vector>

#include "bakers/color/spectral_color.h"

namespace skybake {

struct ColorSample {
    std::vector<double> light;         // at the wavelengths of the fit
    glm::dvec3 color = glm::dvec3(0);  // of the whole spectrum
    double weight = 0;                 // of the difference, at least 0
};

// Returns the weight of each wavelength, for which the sum over samples of
// |weight (sum of light weights - color)|^2 is least. Neighbouring wavelengths have nearly the same
// light, so that many weights would be as good: of these it returns those near color_weights, the
// rule for spectra that are linear between the wavelengths, which may be in any order.
std::vector<glm::dvec3> fit_color_weights(std::span<const double> wavelengths_nm,
                                          const std::vector<ColorSample>& samples,
                                          const ColorTarget& target);

}  // namespace skybake
