// Rounding to what a file's pixel type can hold, and counting what it holds badly.
#pragma once

#include "bakers/field/baked.h"
#include "config/sections/files.h"

namespace skybake {

// The value as the pixel type stores it, by way of float, rounded to nearest: half to even on ties,
// unorm8 and unorm16 to multiples of 1/255 and 1/65535 upwards on ties, as the nearest float.
// Infinity where a half overflows. A unorm type wants values in [0, 1] and goes on beyond them:
// whoever stores asks range_of() first.
float round_to_pixel_type(double value, config::PixelType type);

// What the type holds: a value fits that lies within these bounds, and is thereby finite.
struct PixelRange {
    float low = 0;
    float high = 0;
    bool contains(float value) const { return value >= low && value <= high; }
};
PixelRange range_of(config::PixelType type);

// The same in words: "[0, 1]".
const char* range_text(config::PixelType type);

// The bytes that a value takes.
int bytes_per_value(config::PixelType type);

// The smallest value that the type holds with all its digits. 0 for unorm, whose steps are equal.
double smallest_normal(config::PixelType type);

// The largest error of rounding: relative to a normal value for float and half (half a unit in the
// last place), absolute for unorm (half a step).
double rounding_error(config::PixelType type);

// Rounds a value for storage and counts it if the pixel type holds it badly.
float store(double value, config::PixelType type, RangeCounts& counts);

}  // namespace skybake
