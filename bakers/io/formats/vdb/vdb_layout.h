// How a dense volume lies in a VDB tree: leaves of 8^3 voxels in nodes of 128^3 in nodes of 4096^3,
// every node's children in the order of x, then y, then z. Knows nothing of OpenVDB.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "bakers/field/baked.h"

namespace skybake {

inline constexpr int vdb_leaf_edge = 8;
inline constexpr int vdb_node_edge = 128;
inline constexpr int vdb_upper_node_edge = 4096;

// The cells of edge `edge[axis]` that `box` consists of, each cut to the box, x slowest and z
// fastest. The box begins at a multiple of the edges.
std::vector<VoxelBox> cells_in_tree_order(const VoxelBox& box, const std::array<int, 3>& edge);
std::vector<VoxelBox> cells_in_tree_order(const VoxelBox& box, int edge);

// Where a voxel is among the values of its box, x fastest, then y, then z.
inline std::ptrdiff_t voxel_index(const VoxelBox& box, const std::array<int, 3>& voxel) {
    const auto from = [&](std::size_t axis) {
        return std::ptrdiff_t{voxel[axis]} - box.origin[axis];
    };
    return (from(2) * box.size[1] + from(1)) * box.size[0] + from(0);
}

}  // namespace skybake
