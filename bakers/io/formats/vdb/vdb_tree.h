// The shape of a VDB tree, without OpenVDB. A volume lies in leaves of 8^3 voxels, in nodes of
// 128^3, in nodes of 4096^3; the children of every node are in the order of x, then y, then z. This
// header says which leaves exist and which of their voxels are active.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "bakers/field/level.h"
#include "config/sections/pixel_types.h"

namespace skybake {

// A mask of the 8^3 voxels of a leaf, as it is in the file: voxel (x, y, z) is bit 8 y + z of word
// x.
using VdbLeafMask = std::array<std::uint64_t, 8>;

// The leaves of a 128^3 node, or of a strip of one, in the file's order. The place of a leaf is
// 256 x + 16 y + z, counted in leaves from the node's corner.
struct VdbLeaves {
    std::vector<std::uint16_t> places;  // ascending
    std::vector<VdbLeafMask> active;    // one per place; voxels outside of the volume are inactive
    bool empty() const { return places.empty(); }
};

// A strip is a box within one node. It begins at a multiple of 8 along each axis, and ends at a
// multiple of 8 or at the volume's end.

// Returns where a leaf begins, given the strip that it is in.
std::array<int, 3> leaf_origin(const VoxelBox& strip, std::uint16_t place);

// A column of a node is its leaves of one x. Columns follow each other in the file.
inline constexpr int vdb_node_columns = 16;
inline int vdb_column(std::uint16_t place) { return place / 256; }

// Returns the voxels of a leaf that lie in a box of this size at its corner.
VdbLeafMask voxels_within(const std::array<int, 3>& size);

// Returns leaves in which all voxels of the strip are active.
VdbLeaves all_leaves(const VoxelBox& strip);

// Returns the leaves with the voxels that are not stored as 0 or -0. `values` are x fastest, then
// y, then z. Leaves without such voxels are left out. `type` is half or float32.
VdbLeaves active_leaves(const VoxelBox& strip, const float* values, config::PixelType type);

// Merges the leaves of strips of one node. The strips follow each other along y, in that order.
VdbLeaves merge_leaves(std::span<const VdbLeaves> strips);

// The number of active voxels and their bounds, inclusive. If there are none, last < first.
struct VdbActiveVoxels {
    static constexpr int none = std::numeric_limits<int>::max();
    std::array<int, 3> first = {none, none, none};
    std::array<int, 3> last = {-1, -1, -1};
    std::int64_t count = 0;

    // Adds those of a leaf at a place, which has some.
    void add(const std::array<int, 3>& origin, const VdbLeafMask& active);
    void add(const VoxelBox& strip, const VdbLeaves& leaves);
    void add(const VdbActiveVoxels& others);
};

// The edges of leaves and nodes, in voxels.
inline constexpr int vdb_leaf_edge = 8;
inline constexpr int vdb_node_edge = 128;
inline constexpr int vdb_upper_node_edge = 4096;

// Divides `box` into cells of edge `edge[axis]`, each cut to the box, x slowest and z fastest. The
// box begins at a multiple of the edges.
std::vector<VoxelBox> cells_in_tree_order(const VoxelBox& box, const std::array<int, 3>& edge);
std::vector<VoxelBox> cells_in_tree_order(const VoxelBox& box, int edge);

// Returns the boxes of a volume's 128^3 nodes in the order of its tree.
std::vector<VoxelBox> nodes_in_tree_order(const std::array<int, 3>& size);

// Returns the corner of the node with this edge that a box lies in.
std::array<int, 3> node_corner(const VoxelBox& box, int edge);

// Returns the place in its parent of a child with this edge that begins at `origin`: children are counted
// along x, y and z, of each of which the parent has so many.
std::uint16_t child_place(const std::array<int, 3>& origin, int edge, int children);

}  // namespace skybake
