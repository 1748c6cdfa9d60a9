// Noise by its textbook definition in double precision: the reference from which the errors of
// texels and lookups are measured. It shares with the kernels only what defines the noise, the
// lattice's random numbers and the weights of a recipe; formulas, precision and order of sums are
// its own.
#pragma once

#include <array>
#include <vector>

#include "config/sections/noise.h"

namespace skybake::noise {

// Returns all output channels at a place in units of tiles; the noise repeats outside [0, 1).
std::vector<double> noise_reference(const Noise& noise, const std::array<double, 3>& place);

// Returns the value of cellular noise at a distance from its points.
double worley_value(config::WorleyValue form, double distance);

}  // namespace skybake::noise
