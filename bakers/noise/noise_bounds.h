// Bounds of the values of a noise: those that nothing exceeds, by which regions of a cloud are proved
// empty, and the usual ones.
#pragma once

#include <array>
#include <cstddef>

#include "config/sections/noise.h"

namespace skybake::noise {

// Returns the least and the greatest value that an output channel of a noise can have, in exact
// arithmetic. They are infinite where no bound is known (curl).
std::array<double, 2> value_bounds(const Noise& noise, std::size_t channel);

// Returns the range in which a channel's values are meant to lie: [0, 1], or [-1, 1] for curl,
// mapped through remap, smoothstep, invert, bias and clamp. The range is never empty.
std::array<double, 2> nominal_range(const NoiseChannel& channel);

}  // namespace skybake::noise
