// Shared by the source files of the module skybake_vdb: OpenVDB's types, and the functions of
// VdbCodec. Only these files include it.
#pragma once

#include <openvdb/io/Compression.h>
#include <openvdb/openvdb.h>

#include "bakers/io/formats/vdb/vdb_codec.h"
#include "bakers/io/formats/vdb/vdb_tree.h"

namespace skybake::vdb {

using UpperNode = openvdb::FloatTree::RootNodeType::ChildNodeType;
using LowerNode = UpperNode::ChildNodeType;
using Leaf = openvdb::FloatTree::LeafNodeType;
static_assert(Leaf::DIM == vdb_leaf_edge && LowerNode::DIM == vdb_node_edge &&
              UpperNode::DIM == vdb_upper_node_edge);

// The functions of VdbCodec that encode volumes; vdb_codec.h describes them.
std::string file_head(const std::string& uuid, const Attributes& attributes, int grids);
VdbGridHead grid_head(const VdbGridDescription& grid);
std::string grid_positions(std::uint64_t grid, std::uint64_t voxels, std::uint64_t end);
std::string root(std::size_t upper_nodes, VdbEncoding encoding);
std::string upper_node(const std::array<int, 3>& corner, const std::vector<std::uint16_t>& places,
                       VdbEncoding encoding);
std::string lower_node(const VdbLeaves& leaves, VdbEncoding encoding);
void encode_strip(const VoxelBox& strip, const float* values, const VdbLeaves& leaves,
                  VdbEncoding encoding, VdbStrip& encoded);

// The functions of VdbCodec that read files; vdb_codec.h describes them.
config::Outcome<VdbFile> read(const std::filesystem::path& path);
config::Outcome<FileVoxels> open_grid(const std::filesystem::path& path, const std::string& grid,
                                      VolumePart part, config::NotFinite not_finite);

}  // namespace skybake::vdb
