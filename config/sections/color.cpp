#include "config/sections/color.h"

#include "config/fields/fields.h"
#include "config/sections/sections.h"

namespace skybake::config {
namespace {

constexpr std::array space_choices = {
    Choice{ColorSpace::linear_srgb, "linear_srgb", "primaries of sRGB and Rec. 709, linear"},
    Choice{ColorSpace::display_p3, "display_p3", "primaries of Display P3, linear"},
    Choice{ColorSpace::rec2020, "rec2020", "primaries of Rec. 2020, linear"},
    Choice{ColorSpace::acescg, "acescg", "primaries AP1 of ACES, linear"},
    Choice{ColorSpace::xyz, "xyz", "the observer's tristimulus values"},
    Choice{ColorSpace::none, "none", "the wavelengths themselves"},
};
constexpr std::array observer_choices = {
    Choice{Observer::cie_1931, "cie_1931", "the CIE's standard observer of 1931, 2 degrees"},
};
constexpr std::array sun_choices = {
    Choice{SunSpectrum::measured, "measured", "the sun's spectrum outside the air, of ASTM G173"},
    Choice{SunSpectrum::flat, "flat", "the same at all wavelengths"},
};
constexpr std::array white_choices = {
    Choice{WhitePoint::sun, "sun", "light with the spectrum of the sun is (1, 1, 1)"},
    Choice{WhitePoint::space, "space",
           "the white of the space is: D65, and for acescg nearly D60; the sun is slightly yellow"},
};

const std::array color_table = {
    ColorField{{.key = "space",
                .kind = Kind::choice,
                .choices = space_choices,
                .fallback = R"("linear_srgb")",
                .documentation = "colour space of tables of light"},
               &Color::space},
    ColorField{{.key = "observer",
                .kind = Kind::choice,
                .choices = observer_choices,
                .fallback = R"("cie_1931")",
                .documentation = "whose colour matching functions turn spectra into colours"},
               &Color::observer},
    ColorField{{.key = "sun",
                .kind = Kind::choice,
                .choices = sun_choices,
                .fallback = R"("measured")",
                .documentation = "spectrum of the sun that lights the sky"},
               &Color::sun},
    ColorField{{.key = "white",
                .kind = Kind::choice,
                .choices = white_choices,
                .fallback = R"("sun")",
                .documentation = "which light is white"},
               &Color::white},
};

}  // namespace

std::span<const ColorField> color_fields() { return color_table; }

}  // namespace skybake::config
