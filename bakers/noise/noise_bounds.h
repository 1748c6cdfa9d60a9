// Bounds that no value of a noise exceeds: what proves a region of a cloud empty.
#pragma once

#include <array>
#include <cstddef>

#include "config/sections/noise.h"

namespace skybake::noise {

// The least and the greatest value that an output channel of a noise can have, as real numbers.
// Infinite where no bound is known (curl).
std::array<double, 2> value_bounds(const config::Noise& noise, std::size_t channel);

}  // namespace skybake::noise
