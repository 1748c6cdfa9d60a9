// Bounds of the values of a noise, by which regions of a cloud are proved empty.
#pragma once

#include <array>
#include <cstddef>

#include "config/sections/noise.h"

namespace skybake::noise {

// Returns the least and the greatest value that an output channel of a noise can have, in exact
// arithmetic. They are infinite where no bound is known (curl).
std::array<double, 2> value_bounds(const Noise& noise, std::size_t channel);

}  // namespace skybake::noise
