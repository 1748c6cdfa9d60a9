// Makes PNG files by OpenImageIO; a part of the module skybake_images.
#pragma once

#include "bakers/io/formats/png/image_codec.h"

namespace skybake {

// As ImageCodec::encode_png.
EncodedPicture encode_png(int width, int height, std::span<const std::uint8_t> rgb);

}  // namespace skybake
