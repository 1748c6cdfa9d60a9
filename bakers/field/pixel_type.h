// Rounding to what a file's pixel type can hold, and counting what it holds badly.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

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

// Voxels as files store them: channels interleaved, little-endian, in a pixel type.

// Rounds as round_to_pixel_type does; `out` holds count * channels.size() values. Every value must
// fit the type.
void store_voxels(const std::vector<const float*>& channels, std::size_t count,
                  config::PixelType type, char* out);

// The same of one array that is interleaved already, or has one channel.
void store_values(const float* values, std::size_t count, config::PixelType type, char* out);

// The values that the bytes stand for, exactly; unorm as the nearest floats.
void load_values(const char* bytes, std::size_t count, config::PixelType type, float* out);

// Rounds in place to what a file of the type would hold. Every value must fit the type.
void round_values(float* values, std::size_t count, config::PixelType type);

}  // namespace skybake
