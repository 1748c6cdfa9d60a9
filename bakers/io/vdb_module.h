// Loads the module that knows OpenVDB.
#pragma once

#include <string>

#include "bakers/io/vdb_codec.h"

namespace skybake {

// The codec, or null with the reason. The module, skybake_vdb.so, is looked for in lib/skybake of
// the folders above the program, which is where installed trees and builds have it. It is loaded
// once and stays.
struct LoadedVdbCodec {
    const VdbCodec* codec = nullptr;
    std::string reason;
};
const LoadedVdbCodec& vdb_codec();

}  // namespace skybake
