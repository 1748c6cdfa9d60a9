// Reads pictures as maps over a cloud: one channel of a PNG, TIFF, OpenEXR or Radiance file. The
// file's first bytes decide which format it is, not its name.
#pragma once

#include "bakers/field/image.h"
#include "bakers/io/files/load_module.h"
#include "bakers/io/formats/png/image_codec.h"
#include "config/diagnostics/diagnostic.h"
#include "config/sections/cloud.h"

namespace skybake {

// The greatest width and height of a map.
inline constexpr int largest_map_edge = 16384;

// Reads map.channel of the picture map.path. If a file has several pictures, the first one is read
// at its full size. Integers of n bits (8, 16; and 1, 2, 4) become v / (2^n - 1); halves and floats
// are unchanged. Colours are never multiplied or divided by alpha, and no colour profile is
// applied: only map.color_space says what values mean, and srgb means the transfer function of IEC
// 61966-2-1. Linear values are multiplied by map.factor and, if the map says so, clamped to [0, 1]. An
// OpenEXR file is read over its display window; pixels that it does not have are 0.
//
// E0300: the file cannot be opened, or the module that reads pictures is missing.
// E0304: the file is damaged, of another kind, deep or volumetric, has more than 16384 pixels along
// an edge or integers of another size, is stored upside down, lacks the channel, or has a value that
// is not in [0, 1]; the message says which.
config::Outcome<MapImage> read_map_image(const config::CloudMap& map);

// Returns how many pixels the picture of a map has, by its header; 0 if there is none or it cannot be read.
double map_pixels(const config::CloudMap& map);

// The codec of the module skybake_images.so, which is loaded once.
const LoadedCodec<ImageCodec>& image_codec();

}  // namespace skybake
