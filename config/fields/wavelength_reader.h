// This header reads the wavelengths of a recipe: a list, one of the lists that represent visible
// light best, or a range.
#pragma once

#include <span>
#include <string>

#include "config/fields/kinds.h"

namespace skybake::config {

// Returns the wavelengths in nm, ascending, whose light together with a matrix gives the colours of
// skies best: `best 3`, `best 4`, `best 8` and `best 16`. Empty for other counts.
//
// They were searched for on skies of the Earth under clear and hazy air (wavelength_reader.cpp says
// how); tests/light/sky_colors_test.cpp holds what 4 and 8 of them reach in other airs.
std::span<const double> best_wavelengths_nm(int count);

// Returns the counts for which there are best wavelengths: "3|4|8|16".
std::string best_wavelength_counts();

// Whether a value of `wavelengths` asks for the best ones: "best 4".
bool asks_for_best_wavelengths(const Value& value);

}  // namespace skybake::config
