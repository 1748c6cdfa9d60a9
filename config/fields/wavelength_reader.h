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
// Those of 3 and 4 minimise the error in skies of the Earth under clear and hazy air, with suns down
// to 5 degrees below the horizon. Those of 8 and 16 are the nodes of Gauss's rule for the weight
// ybar + zbar / 2 + xbar / 2 of the CIE 1931 observer between 390 and 720 nm.
std::span<const double> best_wavelengths_nm(int count);

// Returns the counts for which there are best wavelengths: "3|4|8|16".
std::string best_wavelength_counts();

// Whether a value of `wavelengths` asks for the best ones: "best 4".
bool asks_for_best_wavelengths(const Value& value);

}  // namespace skybake::config
