// What the files of the module share: OpenVDB's types. Only they include this.
#pragma once

#include <openvdb/io/Compression.h>
#include <openvdb/openvdb.h>

#include "bakers/io/formats/vdb/vdb_codec.h"
#include "bakers/io/formats/vdb/vdb_layout.h"

namespace skybake::vdb {

using UpperNode = openvdb::FloatTree::RootNodeType::ChildNodeType;
using LowerNode = UpperNode::ChildNodeType;
using Leaf = openvdb::FloatTree::LeafNodeType;
static_assert(Leaf::DIM == vdb_leaf_edge && LowerNode::DIM == vdb_node_edge &&
              UpperNode::DIM == vdb_upper_node_edge);

}  // namespace skybake::vdb
