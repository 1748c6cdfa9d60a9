#include "bakers/io/formats/vdb/vdb_layout.h"

#include <algorithm>
#include <cstddef>

namespace skybake {

std::vector<VoxelBox> cells_in_tree_order(const VoxelBox& box, const std::array<int, 3>& edge) {
    std::array<int, 3> counts{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        counts[axis] = (box.size[axis] + edge[axis] - 1) / edge[axis];
    }
    std::vector<VoxelBox> cells;
    cells.reserve(static_cast<std::size_t>(counts[0]) * static_cast<std::size_t>(counts[1]) *
                  static_cast<std::size_t>(counts[2]));
    for (int x = 0; x < counts[0]; ++x) {
        for (int y = 0; y < counts[1]; ++y) {
            for (int z = 0; z < counts[2]; ++z) {
                const std::array<int, 3> cell = {x, y, z};
                VoxelBox& added = cells.emplace_back();
                for (std::size_t axis = 0; axis < 3; ++axis) {
                    const int first = cell[axis] * edge[axis];
                    added.origin[axis] = box.origin[axis] + first;
                    added.size[axis] = std::min(edge[axis], box.size[axis] - first);
                }
            }
        }
    }
    return cells;
}

std::vector<VoxelBox> cells_in_tree_order(const VoxelBox& box, int edge) {
    return cells_in_tree_order(box, {edge, edge, edge});
}

}  // namespace skybake
