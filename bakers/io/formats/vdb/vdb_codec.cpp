// The codec that the module skybake_vdb exports.
#include "bakers/io/formats/vdb/vdb_codec.h"

#include "bakers/io/formats/vdb/vdb_library.h"

extern "C" const skybake::VdbCodec* skybake_vdb_codec() {
    using namespace skybake::vdb;
    static constexpr skybake::VdbCodec codec = {file_head,    grid_head,  grid_positions,
                                                root,         upper_node, lower_node,
                                                encode_strip, read,       open_grid};
    return &codec;
}
