// Reads a channel of a picture by OpenImageIO; a part of the module skybake_images.
#pragma once

#include "bakers/io/formats/png/image_codec.h"

namespace skybake {

// As ImageCodec::read.
MapPixels read_map(const std::filesystem::path& path, const std::string& channel);

}  // namespace skybake
