#include "bakers/io/formats/vdb/vdb_strips.h"

namespace skybake {
namespace {

// The size of a strip, which is the unit of parallel work. Its rows are as long as a node, because
// some noises are cheap along x. A node has several strips, because small volumes have only one
// node.
constexpr std::array<int, 3> strip_edges = {vdb_node_edge, 32, vdb_node_edge};

}  // namespace

std::vector<VoxelBox> vdb_strips(const std::array<int, 3>& size) {
    std::vector<VoxelBox> strips;
    for (const VoxelBox& upper : cells_in_tree_order({{}, size}, vdb_upper_node_edge)) {
        for (const VoxelBox& node : cells_in_tree_order(upper, vdb_node_edge)) {
            for (const VoxelBox& strip : cells_in_tree_order(node, strip_edges)) {
                strips.push_back(strip);
            }
        }
    }
    return strips;
}

}  // namespace skybake
