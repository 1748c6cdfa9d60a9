// Rounding to what a file's pixel type can hold, and counting what it holds badly.
#pragma once

#include "bakers/core/baked_table.h"
#include "config/parameters.h"

namespace skybake {

// The value as the pixel type stores it, rounded to nearest, half by way of float. Infinity where
// it overflows.
float round_to_pixel_type(double value, config::PixelType type);

// The smallest value that the type holds with all its digits.
double smallest_normal(config::PixelType type);

// The largest relative error of rounding a normal value: half a unit in the last place.
double rounding_error(config::PixelType type);

// Rounds a value for storage and counts it if the pixel type holds it badly.
float store(double value, config::PixelType type, RangeCounts& counts);

}  // namespace skybake
