// Loads the module that knows OpenImageIO.
#pragma once

#include <string>

#include "bakers/io/formats/png/image_codec.h"

namespace skybake {

// The codec, or null with the reason. The module, skybake_images.so, is loaded once and stays; see
// load_module.h for where it is.
struct LoadedImageCodec {
    const ImageCodec* codec = nullptr;
    std::string reason;
};
const LoadedImageCodec& image_codec();

}  // namespace skybake
