// Noise by its textbook definition in double precision: what texel and lookup errors are measured
// against. It shares with the kernels only what defines the noise, the lattice's random numbers and
// the weights of a recipe; formulas, precision and order of sums are its own.
#pragma once

#include <array>
#include <vector>

#include "config/sections/noise.h"

namespace skybake::noise {

// All output channels at a place of the tile, in tiles: [0, 1) and, repeating, beyond.
std::vector<double> noise_reference(const config::Noise& noise, const std::array<double, 3>& place);

}  // namespace skybake::noise
