// From spectra to colours.
//
// A spectrum L is radiance per solar irradiance of the same wavelength: what sky tables tell when
// their sun is 1. Its colour is
//
//     XYZ = integral of L(lambda) E(lambda) (xbar, ybar, zbar)(lambda) d lambda / Y of the sun
//
// taken to a space by color_space.h, with E the sun's spectrum. So L = 1 at all wavelengths has
// Y = 1, and is (1, 1, 1) where the sun is white.
//
// The light of the sun outside the air, at the mean distance of the Earth.
//
// Weights by which the light of a few wavelengths becomes a colour, fitted to spectra whose colours
// are known.
#pragma once

#include <glm/ext/vector_double3.hpp>

#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "bakers/color/color_space.h"

namespace skybake {

// Returns W / (m^2 nm) at a wavelength from 360 to 830 nm, 0 outside: a piecewise linear function
// with a node every 5 nm that is next to the measured spectrum in least squares. So its integral
// with any function that is linear between these nodes, as CIE's matching functions are here, is
// that of the measured spectrum itself; with smooth functions it holds within 1e-4. A single value
// is not the spectrum's: Fraunhofer lines narrower than the nodes' distance pull their neighbours
// down and up.
double solar_irradiance_W_per_m2_nm(double wavelength_nm);

enum class Sunlight {
    measured,  // solar_irradiance_W_per_m2_nm
    flat       // the same irradiance at all wavelengths
};

// XYZ of the sun outside the air with Y = 1.
glm::dvec3 sun_xyz(Sunlight sunlight);

// Lux outside the air at the mean distance of the Earth, from the measured spectrum: 133.1e3.
double solar_illuminance_lux();

// The colours that are wanted.
struct ColorTarget {
    ColorSpace space = ColorSpace::linear_srgb;
    White white = White::sun;
    Sunlight sunlight = Sunlight::measured;
};

// Returns the target of the words by which recipes and files spell it: a space, `white` "sun" or
// "space", `sun` "measured" or "flat". None if there is no such space.
std::optional<ColorTarget> color_target(std::string_view space, std::string_view white,
                                        std::string_view sun);

// For spectra that are known at these wavelengths (ascending, at least one), linear between
// them and constant beyond the first and last: the colour of L is the sum of L[i] * weight[i]. The
// weights add up to the colour of L = 1.
std::vector<glm::dvec3> color_weights(std::span<const double> wavelengths_nm,
                                      const ColorTarget& target);

// The colour of such a spectrum; as many radiances as wavelengths.
glm::dvec3 color_of(std::span<const double> wavelengths_nm, std::span<const double> radiances,
                    const ColorTarget& target);

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
