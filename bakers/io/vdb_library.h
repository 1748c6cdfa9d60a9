// What the files of the module share: OpenVDB's types, and which of a node's children a dense
// volume has. Only they include this.
#pragma once

#include <openvdb/io/Compression.h>
#include <openvdb/openvdb.h>

#include "bakers/io/vdb_codec.h"
#include "bakers/io/vdb_layout.h"

namespace skybake::vdb {

using UpperNode = openvdb::FloatTree::RootNodeType::ChildNodeType;
using LowerNode = UpperNode::ChildNodeType;
using Leaf = openvdb::FloatTree::LeafNodeType;
static_assert(Leaf::DIM == vdb_leaf_edge && LowerNode::DIM == vdb_node_edge &&
              UpperNode::DIM == vdb_upper_node_edge);

// Of a node whose first voxels are a box of this size: the entries that overlap it. Entries are
// children of `child_edge` voxels, or voxels.
template <class Node>
typename Node::NodeMaskType entries_within(const std::array<int, 3>& size, int child_edge) {
    typename Node::NodeMaskType mask;
    for (const VoxelBox& cell : cells_in_tree_order({{}, size}, child_edge)) {
        const auto [x, y, z] = cell.origin;
        mask.setOn(Node::coordToOffset({x, y, z}));
    }
    return mask;
}

// The voxels of a leaf that are in the volume.
inline Leaf::NodeMaskType voxels_within(const std::array<int, 3>& size) {
    const bool whole = size == std::array{vdb_leaf_edge, vdb_leaf_edge, vdb_leaf_edge};
    return whole ? Leaf::NodeMaskType(true) : entries_within<Leaf>(size, 1);
}

}  // namespace skybake::vdb
