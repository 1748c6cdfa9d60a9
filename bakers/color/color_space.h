// Colour spaces by their primaries, and the matrices that lead to them from CIE XYZ.
//
// A sky table tells radiance per solar irradiance. There are these conventions of white:
//
//   sun  The sun outside the air is white: (1, 1, 1). Light that air and ground have not coloured is
//        neutral, as photographs with the camera set to "daylight" show it, and a grey
//        transmittance gives equal channels. The sun's XYZ is carried to the space's white by
//        Bradford's chromatic adaptation.
//   own  The space's own white point (D65, or ACES white) stays white, without adaptation. The sun
//        outside the air has the colour of its 5800 K, about (1.10, 0.98, 0.94) in sRGB. It is for
//        renderers that show absolute colours.
//
// XYZ has no white of its own: there `own` leaves tristimulus values as they are, and `sun` divides
// by the sun's, so that the sun is (1, 1, 1) too.
#pragma once

#include <glm/ext/matrix_double3x3.hpp>
#include <glm/ext/vector_double2.hpp>
#include <glm/ext/vector_double3.hpp>
#include <optional>
#include <span>
#include <string_view>

#include "config/sections/color.h"

namespace skybake {

using config::ColorSpace;

enum class White { sun, own };

// All but none, which has no primaries.
std::span<const ColorSpace> all_color_spaces();

// Return the name of a space as recipes and files spell it, "linear_srgb", and the space of a name.
std::string_view to_string(ColorSpace space);
std::optional<ColorSpace> color_space_named(std::string_view name);

// Chromaticities x, y. Those of XYZ itself are (1, 0), (0, 1), (0, 0) and (1/3, 1/3).
struct Primaries {
    glm::dvec2 red, green, blue, white;
};
Primaries primaries_of(ColorSpace space);

// The XYZ of a chromaticity with Y = 1.
glm::dvec3 xyz_of(glm::dvec2 chromaticity);

// Space -> XYZ and XYZ -> space, where the space's own white has Y = 1 (SMPTE RP 177). GLM's
// matrices are stored by columns: xyz = to_xyz(space) * rgb.
glm::dmat3 to_xyz(ColorSpace space);
glm::dmat3 from_xyz(ColorSpace space);

// Bradford's adaptation (linear, Lam 1985): takes XYZ seen under one white to XYZ that look alike
// under the other.
glm::dmat3 bradford(glm::dvec3 from_white_xyz, glm::dvec3 to_white_xyz);

// XYZ -> space, under a convention of white: light of the XYZ `sun_xyz` becomes (1, 1, 1), unless
// the space's own white stays.
glm::dmat3 from_xyz(ColorSpace space, White white, glm::dvec3 sun_xyz);

}  // namespace skybake
