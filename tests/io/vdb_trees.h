// Trees as OpenVDB writes them.
#pragma once

#include <openvdb/io/File.h>
#include <openvdb/openvdb.h>

#include <sstream>
#include <string>

#include "config/sections/file_formats.h"

namespace skybake::testing {

// The bytes that OpenVDB makes of a tree.
inline std::string tree_bytes(const openvdb::FloatGrid& grid, config::VdbCompression compression,
                              config::PixelType type) {
    std::uint32_t flags = openvdb::io::COMPRESS_ACTIVE_MASK;
    if (compression == config::VdbCompression::zip) flags |= openvdb::io::COMPRESS_ZIP;
    if (compression == config::VdbCompression::blosc) flags |= openvdb::io::COMPRESS_BLOSC;
    std::ostringstream out;
    openvdb::io::setDataCompression(out, flags);
    const bool half = type == config::PixelType::half;
    grid.tree().writeTopology(out, half);
    grid.tree().writeBuffers(out, half);
    return out.str();
}

}  // namespace skybake::testing
