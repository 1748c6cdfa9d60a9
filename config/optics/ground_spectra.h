// Reflectances of measured grounds at each wavelength: the share of the light that leaves a level
// surface in all directions (its albedo), in [0, 1].
//
// ground_spectra.cpp names the source of each.
#pragma once

#include <vector>

#include "config/text/quantity.h"

namespace skybake::config {

enum class Ground { vegetation, sand, snow, sea, mars };

// Returns the spectrum of a ground, by ascending wavelengths.
std::vector<SpectrumPoint> spectrum_of(Ground ground);

// Returns the albedo at a wavelength: linear between the points, of which there are at least two, and
// constant beyond them.
double albedo_at(const std::vector<SpectrumPoint>& spectrum, Length wavelength);

}  // namespace skybake::config
