// This header declares [color], which says in which colours the sky's tables hold light.
#pragma once

namespace skybake::config {

// The colour space of tables of light, by its primaries. `none` keeps the wavelengths.
enum class ColorSpace {
    linear_srgb,  // Rec. 709 primaries, D65
    display_p3,   // linear
    rec2020,      // linear
    acescg,       // AP1, ACES white
    xyz,
    none
};

enum class Observer { cie_1931 };

// The sunlight that the wavelengths of a spectrum are weighted by.
enum class SunSpectrum { measured, flat };

// The light that is white, (1, 1, 1): light with the spectrum of the sun outside the air, or the white of the
// colour space.
enum class WhitePoint { sun, space };

struct Color {
    ColorSpace space = ColorSpace::linear_srgb;
    Observer observer = Observer::cie_1931;
    SunSpectrum sun = SunSpectrum::measured;
    WhitePoint white = WhitePoint::sun;
    bool operator==(const Color&) const = default;
};

}  // namespace skybake::config
