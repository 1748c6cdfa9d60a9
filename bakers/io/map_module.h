// Loads the module that knows OpenImageIO.
#pragma once

#include <string>

#include "bakers/io/map_codec.h"

namespace skybake {

// The codec, or null with the reason. The module, skybake_images.so, is loaded once and stays; see
// load_module.h for where it is.
struct LoadedMapCodec {
    const MapCodec* codec = nullptr;
    std::string reason;
};
const LoadedMapCodec& map_codec();

}  // namespace skybake
