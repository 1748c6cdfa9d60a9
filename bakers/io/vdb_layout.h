// How a dense volume lies in a VDB tree: leaves of 8^3 voxels in nodes of 128^3 in nodes of 4096^3,
// every node's children in the order of x, then y, then z. Knows nothing of OpenVDB.
#pragma once

#include <array>
#include <vector>

#include "bakers/core/volume.h"

namespace skybake {

inline constexpr int vdb_leaf_edge = 8;
inline constexpr int vdb_node_edge = 128;
inline constexpr int vdb_upper_node_edge = 4096;

// The cells of edge `edge[axis]` that `box` consists of, each cut to the box, x slowest and z
// fastest. The box begins at a multiple of the edges.
std::vector<VoxelBox> cells_in_tree_order(const VoxelBox& box, const std::array<int, 3>& edge);
std::vector<VoxelBox> cells_in_tree_order(const VoxelBox& box, int edge);

}  // namespace skybake
