#include "bakers/io/formats/nvdb/nvdb_leaves.h"

#include <algorithm>
#include <bit>
#include <cstring>

#include "bakers/field/baked.h"
#include "bakers/field/pixel_type.h"
#include "bakers/field/voxel_index.h"

namespace skybake {
namespace {

// The voxels of a leaf in its order: z fastest, then y, then x. Those outside of the volume are 0.
struct LeafBlock {
    float* values = nullptr;  // nvdb_leaf_voxels of them
    VdbLeafMask active;

    bool is_all_active() const {
        return std::all_of(active.begin(), active.end(),
                           [](std::uint64_t plane) { return ~plane == 0; });
    }
};

// Copies the leaf at `at`, in voxels of the box.
void gather_leaf(const VoxelBox& box, const float* values, const std::array<int, 3>& at,
                 LeafBlock& leaf) {
    std::array<int, 3> count;
    for (std::size_t a = 0; a < 3; ++a) count[a] = std::min(nvdb_leaf_edge, box.size[a] - at[a]);
    if (count != std::array{nvdb_leaf_edge, nvdb_leaf_edge, nvdb_leaf_edge})
        std::fill_n(leaf.values, nvdb_leaf_voxels, 0.0F);
    for (int z = 0; z < count[2]; ++z) {
        for (int y = 0; y < count[1]; ++y) {
            const float* row = values + index_in({{}, box.size}, {at[0], at[1] + y, at[2] + z});
            float* column = leaf.values + nvdb_leaf_edge * y + z;
            if (count[0] == nvdb_leaf_edge) {
                for (int x = 0; x < nvdb_leaf_edge; ++x) column[x * 64] = row[x];
            } else {
                for (int x = 0; x < count[0]; ++x) column[x * 64] = row[x];
            }
        }
    }
    leaf.active = voxels_within(count);
}

// Keeps the voxels active that are not 0.
void drop_zeros(LeafBlock& leaf) {
    for (std::size_t x = 0; x < leaf.active.size(); ++x) {
        std::uint64_t not_zero = 0;
        for (std::size_t i = 0; i < 64; ++i) {
            not_zero |= std::uint64_t{leaf.values[64 * x + i] != 0} << i;
        }
        leaf.active[x] &= not_zero;
    }
}

bool is_all_zero(const LeafBlock& leaf) {
    std::uint32_t bits = 0;
    for (std::size_t i = 0; i < nvdb_leaf_voxels; ++i) {
        bits |= std::bit_cast<std::uint32_t>(leaf.values[i]) << 1;
    }
    return bits == 0;
}

// Eight lanes, so that no comparison waits for the one before.
struct Extremes {
    static constexpr std::size_t lanes = 8;
    std::array<float, lanes> least;
    std::array<float, lanes> largest;

    void add(std::size_t lane, float value) {
        least[lane] = value < least[lane] ? value : least[lane];
        largest[lane] = value > largest[lane] ? value : largest[lane];
    }
};

void add_extremes(const LeafBlock& leaf, NvdbActive& active) {
    Extremes extremes;
    extremes.least.fill(active.least);
    extremes.largest.fill(active.largest);
    if (leaf.is_all_active()) {
        for (std::size_t i = 0; i < nvdb_leaf_voxels; i += Extremes::lanes) {
            for (std::size_t lane = 0; lane < Extremes::lanes; ++lane) {
                extremes.add(lane, leaf.values[i + lane]);
            }
        }
    } else {
        for (std::size_t x = 0; x < leaf.active.size(); ++x) {
            for (std::uint64_t left = leaf.active[x]; left != 0; left &= left - 1) {
                const auto bit = static_cast<std::size_t>(std::countr_zero(left));
                extremes.add(bit % Extremes::lanes, leaf.values[64 * x + bit]);
            }
        }
    }
    active.least = *std::min_element(extremes.least.begin(), extremes.least.end());
    active.largest = *std::max_element(extremes.largest.begin(), extremes.largest.end());
}

using Leaf = NvdbLeaf<float>;

// Fills in all but the values.
void store_leaf_head(const LeafBlock& block, const NvdbActive& active, Leaf& leaf) {
    constexpr std::uint8_t has_bounds = 2;
    for (std::uint32_t a = 0; a < 3; ++a) {
        const auto axis = static_cast<std::size_t>(a);
        leaf.mBBoxMin[a] = active.first[axis];
        leaf.mBBoxDif[a] = static_cast<std::uint8_t>(active.last[axis] - active.first[axis]);
    }
    leaf.mFlags = has_bounds;
    static_assert(sizeof leaf.mValueMask == sizeof block.active);
    std::memcpy(static_cast<void*>(&leaf.mValueMask), block.active.data(), sizeof block.active);
    leaf.mMinimum = active.least;
    leaf.mMaximum = active.largest;
    leaf.mAverage = 0;
    leaf.mStdDevi = 0;
}

// Leaves of a node along an axis.
constexpr int leaves_along = nvdb_lower_edge / nvdb_leaf_edge;

// Makes the leaves in a part of a node's box, which begins with the node's leaves of number `column`
// along x. Parts follow each other along x, which is the order of leaves.
void make_leaves(const Baked& volume, const VoxelBox& part, int column, NvdbSlot& slot) {
    LeafBlock block;
    std::array<int, 3> at{};
    for (at[0] = 0; at[0] < part.size[0]; at[0] += nvdb_leaf_edge, ++column) {
        for (int y = 0; (at[1] = y * nvdb_leaf_edge) < part.size[1]; ++y) {
            for (int z = 0; (at[2] = z * nvdb_leaf_edge) < part.size[2]; ++z) {
                Leaf& leaf = reinterpret_cast<Leaf*>(slot.memory.data())[slot.node.leaves];
                block.values = leaf.mValues;
                gather_leaf(part, slot.values.data(), at, block);
                if (volume.sparse && is_all_zero(block)) continue;
                if (volume.sparse) drop_zeros(block);
                NvdbActive active;
                active.VdbActiveVoxels::add(
                    {part.origin[0] + at[0], part.origin[1] + at[1], part.origin[2] + at[2]},
                    block.active);
                add_extremes(block, active);
                store_leaf_head(block, active, leaf);
                const int child = (column * leaves_along + y) * leaves_along + z;
                slot.node.children[static_cast<std::size_t>(child / 64)] |= 1ULL << child % 64;
                slot.node.active.add(active);
                ++slot.node.leaves;
            }
        }
    }
}

// The voxels of a part along x. Its floats stay in a processor's cache until they are in leaves.
constexpr int part_edge = 2 * nvdb_leaf_edge;

void make_node(const Baked& volume, const VoxelSource& voxels, std::size_t channel,
               const VoxelBox& box, NvdbSlot& slot) {
    slot.memory.resize(std::size_t{leaves_along} * leaves_along * leaves_along * sizeof(Leaf) /
                       sizeof(NvdbUnit));
    std::vector<float*> planes(volume.channel_names.size(), nullptr);
    for (int x = 0; x < box.size[0]; x += part_edge) {
        const VoxelBox part = {{box.origin[0] + x, box.origin[1], box.origin[2]},
                               {std::min(part_edge, box.size[0] - x), box.size[1], box.size[2]}};
        slot.values.resize(static_cast<std::size_t>(part.count()));
        planes[channel] = slot.values.data();
        voxels.fill(part, planes);
        round_values(slot.values.data(), slot.values.size(), volume.pixel_type);
        make_leaves(volume, part, x / nvdb_leaf_edge, slot);
    }
    slot.leaves = {reinterpret_cast<const char*>(slot.memory.data()),
                   slot.node.leaves * sizeof(Leaf)};
}

}  // namespace

void NvdbActive::add(const NvdbActive& part) {
    VdbActiveVoxels::add(part);
    least = std::min(least, part.least);
    largest = std::max(largest, part.largest);
}

void make_nvdb_leaves(const Baked& volume, const Level& level, std::size_t channel,
                      const VoxelBox& box, NvdbSlot& slot) {
    slot.leaves = {};
    slot.node = {};
    if (volume.sparse && level.voxels->is_empty(box)) return;
    make_node(volume, *level.voxels, channel, box, slot);
}

}  // namespace skybake
