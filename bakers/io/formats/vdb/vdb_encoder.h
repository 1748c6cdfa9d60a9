// Volumes to bytes, with OpenVDB. The functions of VdbCodec that write, see there.
#pragma once

#include "bakers/io/formats/vdb/vdb_codec.h"

namespace skybake::vdb {

std::string file_head(const std::string& uuid, const Attributes& attributes, int grids);
VdbGridHead grid_head(const VdbGridDescription& grid);
std::string grid_positions(std::uint64_t grid, std::uint64_t voxels, std::uint64_t end);
std::string root(std::size_t upper_nodes);
std::string upper_node(const std::array<int, 3>& corner, const std::vector<std::uint16_t>& places,
                       VdbEncoding encoding);
std::string lower_node(const VdbLeaves& leaves, VdbEncoding encoding);
void encode_strip(const VoxelBox& strip, const float* values, const VdbLeaves& leaves,
                  VdbEncoding encoding, VdbStrip& encoded);

}  // namespace skybake::vdb
