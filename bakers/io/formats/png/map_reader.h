// Reads a channel of a picture by OpenImageIO; a part of the module skybake_images.
#pragma once

#include <istream>
#include <optional>
#include <string>

#include "bakers/io/formats/png/image_codec.h"

namespace skybake {

// As ImageCodec::read.
MapPixels read_map(const std::filesystem::path& path, const std::string& channel);

// The chunks of a PNG file, before its pixels are decoded.

// What is wrong with the chunks of the PNG file in `file`, or nothing: each has the checksum that
// goes with it, and the last is IEND. (What follows that is not the picture's.)
//
// The library that decodes pixels stops reading with the last pixel: it takes files that lack their
// end, and rows from a chunk whose checksum it has not come to yet. It also prints what it finds.
std::optional<std::string> png_damage(std::istream& file);

}  // namespace skybake
