// VDB files to descriptions and voxels, with OpenVDB. The functions of VdbCodec that read, see
// there.
#pragma once

#include "bakers/io/formats/vdb/vdb_codec.h"

namespace skybake::vdb {

config::Outcome<VdbFile> read(const std::filesystem::path& path);
config::Outcome<bool> read_voxels(const std::filesystem::path& path,
                                  const std::function<bool(const VdbSlab& slab)>& visit);

}  // namespace skybake::vdb
