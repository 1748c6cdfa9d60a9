// Voxels as files store them: channels interleaved, little-endian, in a pixel type.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "config/sections/files.h"

namespace skybake {

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
