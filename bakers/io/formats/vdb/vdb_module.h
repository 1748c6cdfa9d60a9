// Loads the module that knows OpenVDB.
#pragma once

#include <string>

#include "bakers/io/formats/vdb/vdb_codec.h"

namespace skybake {

// The codec, or null with the reason. The module, skybake_vdb.so, is loaded once and stays; see
// load_module.h for where it is.
struct LoadedVdbCodec {
    const VdbCodec* codec = nullptr;
    std::string reason;
};
const LoadedVdbCodec& vdb_codec();

}  // namespace skybake
