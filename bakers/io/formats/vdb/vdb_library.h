// Shared by the source files of the module skybake_vdb: OpenVDB's types, and the functions of
// VdbCodec that read. Only these files include it.
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

// The functions of VdbCodec that read files; vdb_codec.h describes them.
config::Outcome<VdbFile> read(const std::filesystem::path& path);
config::Outcome<FileVoxels> open_grid(const std::filesystem::path& path, const std::string& grid,
                                      VolumePart part, config::NotFinite not_finite);

}  // namespace skybake::vdb
