// Volumes to bytes, with OpenVDB. The functions of VdbCodec that write, see there.
#pragma once

#include "bakers/io/vdb_codec.h"

namespace skybake::vdb {

std::string file_head(const std::string& uuid, const Attributes& attributes, int grids);
VdbGridHead grid_head(const VdbGridDescription& grid);
std::string grid_positions(std::uint64_t grid, std::uint64_t voxels, std::uint64_t end);
void topology(const std::array<int, 3>& size, VdbEncoding encoding,
              const std::function<bool(std::string_view)>& sink);
void encode_strip(const VoxelBox& strip, const float* values, VdbEncoding encoding,
                  VdbStrip& encoded);

}  // namespace skybake::vdb
