#include "bakers/io/formats/vdb/vdb_tree.h"

#include <algorithm>
#include <bit>

#include "bakers/field/voxel_index.h"

namespace skybake {
namespace {

constexpr int leaf_edge = vdb_leaf_edge;

// Returns the place of a leaf, counted in leaves from the corner of its node.
std::uint16_t place_of(const std::array<int, 3>& leaf_origin) {
    return child_place(leaf_origin, leaf_edge, vdb_node_edge / leaf_edge);
}

// Returns the bits, without the sign, of the largest float that is stored as 0. For half it is
// 2^-25, which is half of the least half: the tie rounds to even, which is 0.
std::uint32_t largest_zero(config::PixelType type) {
    return type == config::PixelType::half ? std::bit_cast<std::uint32_t>(0x1p-25F) : 0;
}

std::uint32_t magnitude(float value) { return std::bit_cast<std::uint32_t>(value) & 0x7fffffffU; }

// Tells which leaves of a strip, x slowest, have an active voxel.
std::vector<char> find_occupied(const VoxelBox& strip, const float* values, std::uint32_t zero) {
    const auto leaves_along = [&](std::size_t axis) {
        return static_cast<std::size_t>((strip.size[axis] + leaf_edge - 1) / leaf_edge);
    };
    const std::size_t column = leaves_along(1) * leaves_along(2);
    std::vector<char> occupied(leaves_along(0) * column);
    for (int z = 0; z < strip.size[2]; ++z) {
        for (int y = 0; y < strip.size[1]; ++y) {
            char* leaf = occupied.data() +
                         static_cast<std::size_t>(y / leaf_edge) * leaves_along(2) +
                         static_cast<std::size_t>(z / leaf_edge);
            const float* const end = values + strip.size[0];
            for (; end - values >= leaf_edge; values += leaf_edge, leaf += column) {
                std::uint32_t any = 0;
                for (int x = 0; x < leaf_edge; ++x) any |= magnitude(values[x]) > zero ? 1U : 0U;
                *leaf = static_cast<char>(*leaf | static_cast<char>(any));
            }
            for (; values != end; ++values) {
                if (magnitude(*values) > zero) *leaf = 1;
            }
        }
    }
    return occupied;
}

VdbLeafMask active_voxels(const VoxelBox& strip, const float* values, const VoxelBox& leaf,
                          std::uint32_t zero) {
    VdbLeafMask mask{};
    for (int z = 0; z < leaf.size[2]; ++z) {
        for (int y = 0; y < leaf.size[1]; ++y) {
            const auto [left, front, bottom] = leaf.origin;
            const float* const row = values + index_in(strip, {left, front + y, bottom + z});
            for (int x = 0; x < leaf.size[0]; ++x) {
                const std::uint64_t active = magnitude(row[x]) > zero ? 1 : 0;
                mask[static_cast<std::size_t>(x)] |= active << (8 * y + z);
            }
        }
    }
    return mask;
}

}  // namespace

std::array<int, 3> leaf_origin(const VoxelBox& strip, std::uint16_t place) {
    const std::array<int, 3> leaves = {place / 256, place / 16 % 16, place % 16};
    std::array<int, 3> origin = node_corner(strip, vdb_node_edge);
    for (std::size_t axis = 0; axis < 3; ++axis) origin[axis] += leaves[axis] * leaf_edge;
    return origin;
}

VdbLeafMask voxels_within(const std::array<int, 3>& size) {
    std::uint64_t plane = 0;
    for (int y = 0; y < size[1]; ++y) plane |= ((std::uint64_t{2} << (size[2] - 1)) - 1) << (8 * y);
    VdbLeafMask mask{};
    std::fill_n(mask.begin(), size[0], plane);
    return mask;
}

VdbLeaves all_leaves(const VoxelBox& strip) {
    VdbLeaves leaves;
    for (const VoxelBox& leaf : cells_in_tree_order(strip, leaf_edge)) {
        leaves.places.push_back(place_of(leaf.origin));
        leaves.active.push_back(voxels_within(leaf.size));
    }
    return leaves;
}

VdbLeaves active_leaves(const VoxelBox& strip, const float* values, config::PixelType type) {
    const std::uint32_t zero = largest_zero(type);
    const std::vector<char> occupied = find_occupied(strip, values, zero);
    const std::vector<VoxelBox> cells = cells_in_tree_order(strip, leaf_edge);
    VdbLeaves leaves;
    for (std::size_t i = 0; i < cells.size(); ++i) {
        if (occupied[i] == 0) continue;
        leaves.places.push_back(place_of(cells[i].origin));
        leaves.active.push_back(active_voxels(strip, values, cells[i], zero));
    }
    return leaves;
}

VdbLeaves merge_leaves(std::span<const VdbLeaves> strips) {
    VdbLeaves merged;
    std::vector<std::size_t> next(strips.size(), 0);
    for (int column = 0; column < vdb_node_columns; ++column) {
        for (std::size_t i = 0; i < strips.size(); ++i) {
            const VdbLeaves& strip = strips[i];
            for (std::size_t& leaf = next[i];
                 leaf < strip.places.size() && vdb_column(strip.places[leaf]) == column; ++leaf) {
                merged.places.push_back(strip.places[leaf]);
                merged.active.push_back(strip.active[leaf]);
            }
        }
    }
    return merged;
}

void VdbActiveVoxels::add(const std::array<int, 3>& origin, const VdbLeafMask& active) {
    // The masks tell which x, y and z have an active voxel: x in every eighth bit of x_mask, y
    // in groups of eight bits of yz_mask, and z in the lowest eight bits of z_mask.
    std::uint64_t x_mask = 0, yz_mask = 0, z_mask = 0;
    for (std::size_t x = 0; x < active.size(); ++x) {
        count += std::popcount(active[x]);
        x_mask |= std::uint64_t{active[x] != 0} << 8 * x;
        yz_mask |= active[x];
    }
    for (int y = 0; y < leaf_edge; ++y) z_mask |= yz_mask >> 8 * y & 0xffU;
    const std::array<int, 3> low = {std::countr_zero(x_mask) / 8, std::countr_zero(yz_mask) / 8,
                                    std::countr_zero(z_mask)};
    const std::array<int, 3> high = {(63 - std::countl_zero(x_mask)) / 8,
                                     (63 - std::countl_zero(yz_mask)) / 8,
                                     63 - std::countl_zero(z_mask)};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        first[axis] = std::min(first[axis], origin[axis] + low[axis]);
        last[axis] = std::max(last[axis], origin[axis] + high[axis]);
    }
}

void VdbActiveVoxels::add(const VoxelBox& strip, const VdbLeaves& leaves) {
    for (std::size_t i = 0; i < leaves.places.size(); ++i) {
        add(leaf_origin(strip, leaves.places[i]), leaves.active[i]);
    }
}

void VdbActiveVoxels::add(const VdbActiveVoxels& others) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
        first[axis] = std::min(first[axis], others.first[axis]);
        last[axis] = std::max(last[axis], others.last[axis]);
    }
    count += others.count;
}

std::array<int, 3> node_corner(const VoxelBox& box, int edge) {
    std::array<int, 3> corner = box.origin;
    for (int& coordinate : corner) coordinate -= coordinate % edge;
    return corner;
}

std::uint16_t child_place(const std::array<int, 3>& origin, int edge, int children) {
    int place = 0;
    for (const int coordinate : origin) place = children * place + coordinate / edge % children;
    return static_cast<std::uint16_t>(place);
}

std::vector<VoxelBox> nodes_in_tree_order(const std::array<int, 3>& size) {
    std::vector<VoxelBox> nodes;
    for (const VoxelBox& upper : cells_in_tree_order({{}, size}, vdb_upper_node_edge)) {
        const std::vector<VoxelBox> below = cells_in_tree_order(upper, vdb_node_edge);
        nodes.insert(nodes.end(), below.begin(), below.end());
    }
    return nodes;
}

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
