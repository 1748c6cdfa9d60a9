// Colours of numbers. Both maps change evenly for the eye and keep their order for readers who do
// not see red and green apart.
#pragma once

#include "bakers/plot/canvas.h"

namespace skybake {

// viridis, from dark violet to yellow, lightness rising throughout; t in [0, 1]. The colour map of
// S. van der Walt and N. Smith (CC0), by the polynomials of M. Zucker (CC0), which are within 1 %
// of it.
Colour sequential_colour(double t);

// From dark blue over white at 1/2 to dark red; t in [0, 1].
Colour diverging_colour(double t);

}  // namespace skybake
