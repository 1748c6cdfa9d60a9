#include "config/sections/color.h"

#include "config/fields/fields.h"
#include "config/sections/sections.h"

namespace skybake::config {
namespace {

constexpr Choice space_choices[] = {
    {ColorSpace::linear_srgb, "linear_srgb", "primaries of sRGB and Rec. 709, linear"},
    {ColorSpace::display_p3, "display_p3", "primaries of Display P3, linear"},
    {ColorSpace::rec2020, "rec2020", "primaries of Rec. 2020, linear"},
    {ColorSpace::acescg, "acescg", "primaries AP1 of ACES, linear"},
    {ColorSpace::xyz, "xyz", "the observer's tristimulus values"},
    {ColorSpace::none, "none", "the wavelengths themselves"},
};
constexpr Choice observer_choices[] = {
    {Observer::cie_1931, "cie_1931", "the CIE's standard observer of 1931, 2 degrees"},
};
constexpr Choice sun_choices[] = {
    {SunSpectrum::measured, "measured", "the sun's spectrum outside the air, of ASTM G173"},
    {SunSpectrum::flat, "flat", "the same at all wavelengths"},
};
constexpr Choice white_choices[] = {
    {WhitePoint::sun, "sun", "light with the spectrum of the sun is (1, 1, 1)"},
    {WhitePoint::space, "space",
     "the white of the space is: D65, and for acescg nearly D60; the sun is slightly yellow"},
};

const Row<Color> color_table[] = {
    {"space", Kind::choice, &Color::space, "colour space of tables of light", space_choices,
     Default{R"("linear_srgb")"}},
    {"observer", Kind::choice, &Color::observer,
     "whose colour matching functions turn spectra into colours", observer_choices,
     Default{R"("cie_1931")"}},
    {"sun", Kind::choice, &Color::sun, "spectrum of the sun that lights the sky", sun_choices,
     Default{R"("measured")"}},
    {"white", Kind::choice, &Color::white, "which light is white", white_choices,
     Default{R"("sun")"}},
};

}  // namespace

std::span<const Row<Color>> color_fields() { return color_table; }

}  // namespace skybake::config
