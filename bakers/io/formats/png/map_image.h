// Pictures as maps over a cloud: one channel of a PNG, TIFF or OpenEXR file. Which of them a file
// is its first bytes say, not its name.
#pragma once

#include <string>

#include "bakers/field/image.h"
#include "bakers/io/formats/png/image_codec.h"
#include "config/diagnostics/diagnostic.h"
#include "config/sections/cloud.h"

namespace skybake {

// The greatest width and height of a map.
inline constexpr int largest_map_edge = 16384;

// Reads map.channel of the picture map.path; a file of several pictures has the first one read, at
// its full size. Integers of n bits (8, 16; and 1, 2, 4) are v / (2^n - 1), halves and floats are
// as they are. Colours are never multiplied or divided by alpha, and no colour profile is applied:
// map.color_space alone says what values mean, srgb the transfer function of IEC 61966-2-1.
// E0300: the file cannot be opened, or the module that reads pictures is not there.
// E0304: damaged, of another kind, deep or volumetric, of more than 16384 pixels along an edge, of
// other integers, stored upside down or cropped in a way that readers disagree about, without the
// channel, or with a value that is not in [0, 1]; the message says which.
config::Outcome<MapImage> read_map_image(const config::CloudMap& map);

// Loads the module that knows OpenImageIO.

// The codec, or null with the reason. The module, skybake_images.so, is loaded once and stays; see
// load_module.h for where it is.
struct LoadedImageCodec {
    const ImageCodec* codec = nullptr;
    std::string reason;
};
const LoadedImageCodec& image_codec();

}  // namespace skybake
