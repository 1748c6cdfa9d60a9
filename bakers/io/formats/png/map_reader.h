// Reads a channel of a picture by OpenImageIO, and checks a PNG file before it is decoded. This is
// a part of the module skybake_images.
#pragma once

#include <istream>
#include <optional>
#include <string>

#include "bakers/io/formats/png/image_codec.h"

namespace skybake {

// The module's implementation of ImageCodec::read.
MapPixels read_map(const std::filesystem::path& path, const std::string& channel, int count);

// Returns what is wrong with the chunks of a PNG file, or nothing. Each chunk must have the right
// checksum, and the last must be IEND; bytes after it do not belong to the picture.
//
// Call this before the pixels are decoded. The library that decodes them stops reading at the last
// pixel, so it accepts files that lack their end, and rows from a chunk whose checksum it has not
// reached. It also prints what it finds.
std::optional<std::string> png_damage(std::istream& file);

}  // namespace skybake
