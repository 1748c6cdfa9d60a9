// Which voxels of a VDB tree are active: the leaves that exist, and a mask of each. Knows nothing
// of OpenVDB.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "bakers/field/baked.h"
#include "config/sections/files.h"

namespace skybake {

// Of the 8^3 voxels of a leaf: voxel (x, y, z) is bit 8 y + z of word x. So it is in the file.
using VdbLeafMask = std::array<std::uint64_t, 8>;

// The leaves of a 128^3 node, or of a strip of one, in the file's order. The place of a leaf is
// 256 x + 16 y + z, counted in leaves from the node's corner.
struct VdbLeaves {
    std::vector<std::uint16_t> places;  // ascending
    std::vector<VdbLeafMask> active;    // one per place; voxels outside of the volume are not
    bool empty() const { return places.empty(); }
};

// A strip is a box within one node that begins at a multiple of 8 along each axis, and ends at one
// or at the volume's end.

// Where a leaf begins, given the strip that it is in.
std::array<int, 3> leaf_origin(const VoxelBox& strip, std::uint16_t place);

// The columns of a node: its leaves of one x. They follow each other in the file.
inline constexpr int vdb_node_columns = 16;
inline int vdb_column(std::uint16_t place) { return place / 256; }

// All voxels of the strip.
VdbLeaves all_leaves(const VoxelBox& strip);

// The voxels whose values, x fastest, then y, then z, are stored as something else than 0 or -0;
// leaves without any are left out. `type` is half or float32.
VdbLeaves active_leaves(const VoxelBox& strip, const float* values, config::PixelType type);

// Of strips of one node that follow each other along y, in that order.
VdbLeaves merge_leaves(std::span<const VdbLeaves> strips);

// How many voxels are active, and their bounds, inclusive: last < first where there are none.
struct VdbActiveVoxels {
    static constexpr int none = std::numeric_limits<int>::max();
    std::array<int, 3> first = {none, none, none};
    std::array<int, 3> last = {-1, -1, -1};
    std::int64_t count = 0;

    void add(const VoxelBox& strip, const VdbLeaves& leaves);
};

// How a dense volume lies in a VDB tree: leaves of 8^3 voxels in nodes of 128^3 in nodes of 4096^3,
// every node's children in the order of x, then y, then z. Knows nothing of OpenVDB.
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
