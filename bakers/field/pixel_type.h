// Rounds values to what a file's pixel type can hold, counts values that it holds inaccurately, and
// converts voxels to the bytes of a file and back.
//
// RGBE, the texels of Radiance pictures: three numbers that are not negative, each 8 bits, with the
// exponent of the power of two above the largest of them. It rounds to half a step, at most 0.4 % of the
// largest. Numbers are steps of 2^(exponent - 8), without the half step that Radiance's own programs add,
// as most readers have it; below 1e-32 they are 0.
//
// Source: Ward, "Real Pixels", Graphics Gems II, 1991.
#pragma once

#include <cstddef>
#include <vector>

#include "bakers/field/conventions.h"
#include "config/sections/pixel_types.h"

namespace skybake {

// Returns the value as the pixel type stores it. The value is converted to float and rounded to
// nearest: for half, ties go to even; for unorm8 and unorm16, the result is the float nearest to a
// multiple of 1/255 or 1/65535, and ties go upwards. The result is infinite if a half overflows. A
// unorm type expects values in [0, 1] and does not clamp others, so check range_of() before
// storing. Types that code blocks, and rgbe, hold decoded values, which are not rounded further
// (block_voxels.h): they are stored as floats wherever this header stores values.
float round_to_pixel_type(double value, config::PixelType type);

// The range of a pixel type. Every value within these bounds fits and is finite.
struct PixelRange {
    float low = 0;
    float high = 0;
    bool contains(float value) const { return value >= low && value <= high; }
};
PixelRange range_of(config::PixelType type);

// Returns the range in words: "[0, 1]".
const char* range_text(config::PixelType type);

// The number of bytes per value; of types that code blocks, per decoded value.
std::size_t bytes_per_value(config::PixelType type);

// The smallest positive value that the type holds in full precision; 0 for unorm, whose steps are
// equal.
double smallest_normal(config::PixelType type);

// Returns the bits that a value takes in a file without compression. Blocks are whole.
double bits_per_value(config::PixelType type);

// The largest rounding error: relative to a normal value for float and half (half a unit in the
// last place), absolute for unorm (half a step).
double rounding_error(config::PixelType type);

// Rounds a value for storage, and counts it if the pixel type cannot hold it accurately.
float store(double value, config::PixelType type, RangeCounts& counts);

// Writes voxels to `out` as files store them: channels interleaved, little-endian, rounded as
// round_to_pixel_type does. `out` has room for count * channels.size() values. Every value must fit
// the type.
void store_voxels(const std::vector<const float*>& channels, std::size_t count,
                  config::PixelType type, char* out);

// Does the same for one array that is already interleaved or has one channel.
void store_values(const float* values, std::size_t count, config::PixelType type, char* out);

// Converts stored bytes to floats: exactly, but for unorm to the nearest floats.
void load_values(const char* bytes, std::size_t count, config::PixelType type, float* out);

inline constexpr float largest_rgbe = 0x1.FEp126F;  // 255 steps of 2^119

// Rounds the values in place to what a file of the type holds. Every value must fit the type; for rgbe,
// three channels are interleaved, and a texel that is not in [0, largest_rgbe] stays as it is.
void round_values(float* values, std::size_t count, config::PixelType type);

}  // namespace skybake
