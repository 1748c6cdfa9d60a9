#include "bakers/io/formats/nvdb/nvdb_leaves.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <vector>

#include "bakers/field/leaf_codes.h"
#include "bakers/field/pixel_type.h"
#include "bakers/io/formats/nvdb/nvdb_layout.h"

namespace skybake {
namespace {

// The voxels of a leaf in its order: z fastest, then y, then x. Those outside of the volume are 0.
struct LeafBlock {
    alignas(64) std::array<float, nvdb_leaf_voxels> values;
    std::array<std::uint64_t, nvdb_leaf_edge> active;  // of each x; bit 8 y + z
};

// Copies the leaf at `at`, in voxels of the box.
void gather_leaf(const VoxelBox& box, const float* values, const std::array<int, 3>& at,
                 LeafBlock& leaf) {
    std::array<int, 3> count;
    for (std::size_t a = 0; a < 3; ++a) count[a] = std::min(nvdb_leaf_edge, box.size[a] - at[a]);
    if (count != std::array{nvdb_leaf_edge, nvdb_leaf_edge, nvdb_leaf_edge}) leaf.values.fill(0);
    const auto width = static_cast<std::size_t>(box.size[0]);
    for (int z = 0; z < count[2]; ++z) {
        for (int y = 0; y < count[1]; ++y) {
            const auto line =
                static_cast<std::size_t>(at[2] + z) * static_cast<std::size_t>(box.size[1]) +
                static_cast<std::size_t>(at[1] + y);
            const float* row = values + line * width + static_cast<std::size_t>(at[0]);
            float* column = leaf.values.data() + nvdb_leaf_edge * y + z;
            if (count[0] == nvdb_leaf_edge) {
                for (int x = 0; x < nvdb_leaf_edge; ++x) column[x * 64] = row[x];
            } else {
                for (int x = 0; x < count[0]; ++x) column[x * 64] = row[x];
            }
        }
    }
    for (int x = 0; x < nvdb_leaf_edge; ++x) {
        std::uint64_t line = 0;
        for (int y = 0; y < count[1]; ++y) line |= ((1ULL << count[2]) - 1) << 8 * y;
        leaf.active[static_cast<std::size_t>(x)] = x < count[0] ? line : 0;
    }
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
    for (const float value : leaf.values) bits |= std::bit_cast<std::uint32_t>(value) << 1;
    return bits == 0;
}

// Eight lanes, so that no comparison waits for the one before.
void add_extremes(const LeafBlock& leaf, NvdbActive& active) {
    constexpr std::size_t lanes = 8;
    std::array<float, lanes> least;
    std::array<float, lanes> largest;
    least.fill(active.least);
    largest.fill(active.largest);
    for (std::size_t i = 0; i < nvdb_leaf_voxels; i += lanes) {
        const std::uint64_t on = leaf.active[i / 64] >> i % 64;
        for (std::size_t lane = 0; lane < lanes; ++lane) {
            const float value = leaf.values[i + lane];
            const bool counts = (on >> lane & 1) != 0;
            least[lane] = counts && value < least[lane] ? value : least[lane];
            largest[lane] = counts && value > largest[lane] ? value : largest[lane];
        }
    }
    active.least = *std::min_element(least.begin(), least.end());
    active.largest = *std::max_element(largest.begin(), largest.end());
}

// Summarizes the active voxels of a leaf that has some.
NvdbActive leaf_summary(const LeafBlock& leaf, const std::array<int, 3>& origin) {
    NvdbActive active;
    std::uint64_t any = 0;
    for (int x = 0; x < nvdb_leaf_edge; ++x) {
        const std::uint64_t plane = leaf.active[static_cast<std::size_t>(x)];
        if (plane == 0) continue;
        active.first[0] = std::min(active.first[0], origin[0] + x);
        active.last[0] = origin[0] + x;
        active.voxels += static_cast<std::uint64_t>(std::popcount(plane));
        any |= plane;
    }
    std::uint64_t depth = any | any >> 32;  // bits 0 to 7 become those of z
    depth |= depth >> 16;
    depth = (depth | depth >> 8) & 0xFF;
    active.first[1] = origin[1] + std::countr_zero(any) / 8;
    active.last[1] = origin[1] + 7 - std::countl_zero(any) / 8;
    active.first[2] = origin[2] + std::countr_zero(depth);
    active.last[2] = origin[2] + 63 - std::countl_zero(depth);
    add_extremes(leaf, active);
    return active;
}

// Fills in what all leaves have in common.
template <class Leaf>
void store_leaf_head(const LeafBlock& block, const NvdbActive& active, Leaf& leaf) {
    constexpr std::uint8_t has_bounds = 2;
    for (int a = 0; a < 3; ++a) {
        const auto axis = static_cast<std::size_t>(a);
        leaf.mBBoxMin[a] = active.first[axis];
        leaf.mBBoxDif[a] = static_cast<std::uint8_t>(active.last[axis] - active.first[axis]);
    }
    leaf.mFlags = has_bounds;
    static_assert(sizeof leaf.mValueMask == sizeof block.active);
    std::memcpy(static_cast<void*>(&leaf.mValueMask), block.active.data(), sizeof block.active);
}

// Appends a leaf of zeroed memory.
template <class Leaf>
Leaf& append_leaf(std::string& leaves) {
    leaves.resize(leaves.size() + sizeof(Leaf));
    return *reinterpret_cast<Leaf*>(leaves.data() + leaves.size() - sizeof(Leaf));
}

// How leaves of floats are made: values are as stored.
struct FloatLeaves {
    bool begin(LeafBlock& block, bool is_sparse) const {
        if (!is_sparse) return true;
        if (is_all_zero(block)) return false;
        drop_zeros(block);
        return true;
    }
    void append(const LeafBlock& block, const NvdbActive& active, std::string& leaves) const {
        auto& leaf = append_leaf<NvdbLeaf<float>>(leaves);
        store_leaf_head(block, active, leaf);
        leaf.mMinimum = active.least;
        leaf.mMaximum = active.largest;
        std::memcpy(leaf.mValues, block.values.data(), sizeof leaf.mValues);
    }
};

// How leaves of codes are made: values are those before coding, and become those after it.
template <class Build>
struct CodedLeaves {
    using Leaf = NvdbLeaf<Build>;
    std::array<std::uint16_t, nvdb_leaf_voxels> codes{};
    LeafCodes scale;

    bool begin(LeafBlock& block, bool is_sparse) {
        if (is_sparse && is_all_zero(block)) return false;
        scale =
            quantize_leaf(block.values.data(), nvdb_leaf_voxels, Leaf::bitWidth(), codes.data());
        for (std::size_t i = 0; i < nvdb_leaf_voxels; ++i) block.values[i] = scale.value(codes[i]);
        if (!is_sparse) return true;
        drop_zeros(block);
        return std::any_of(block.active.begin(), block.active.end(),
                           [](std::uint64_t plane) { return plane != 0; });
    }
    void append(const LeafBlock& block, const NvdbActive& active, std::string& leaves) const {
        auto& leaf = append_leaf<Leaf>(leaves);
        store_leaf_head(block, active, leaf);
        leaf.mMinimum = scale.minimum;
        leaf.mQuantum = scale.quantum;
        if (scale.quantum != 0) {
            leaf.setMin(active.least);
            leaf.setMax(active.largest);
        }
        std::copy(codes.begin(), codes.end(), leaf.mCode);
    }
};

template <class Leaves>
void make_leaves(const Baked& volume, const VoxelBox& box, Leaves maker, NvdbSlot& slot) {
    constexpr int edge = nvdb_lower_edge / nvdb_leaf_edge;
    LeafBlock block;
    for (int x = 0; x < edge; ++x) {
        for (int y = 0; y < edge; ++y) {
            for (int z = 0; z < edge; ++z) {
                const std::array<int, 3> at = {x * nvdb_leaf_edge, y * nvdb_leaf_edge,
                                               z * nvdb_leaf_edge};
                if (at[0] >= box.size[0] || at[1] >= box.size[1] || at[2] >= box.size[2]) continue;
                gather_leaf(box, slot.values.data(), at, block);
                if (!maker.begin(block, volume.sparse)) continue;
                const NvdbActive active = leaf_summary(
                    block, {box.origin[0] + at[0], box.origin[1] + at[1], box.origin[2] + at[2]});
                maker.append(block, active, slot.leaves);
                const std::uint32_t child = nvdb_child({x, y, z}, 4);
                slot.node.children[child / 64] |= 1ULL << child % 64;
                slot.node.active.add(active);
                ++slot.node.leaves;
            }
        }
    }
}

}  // namespace

void NvdbActive::add(const NvdbActive& part) {
    for (std::size_t a = 0; a < 3; ++a) {
        first[a] = std::min(first[a], part.first[a]);
        last[a] = std::max(last[a], part.last[a]);
    }
    least = std::min(least, part.least);
    largest = std::max(largest, part.largest);
    voxels += part.voxels;
}

void make_nvdb_leaves(const Baked& volume, const Level& level, std::size_t channel,
                      const VoxelBox& box, NvdbSlot& slot) {
    slot.leaves.clear();
    slot.node = {};
    const VoxelSource& voxels = level.uncoded != nullptr ? *level.uncoded : *level.voxels;
    if (volume.sparse && voxels.is_empty(box)) return;
    slot.values.resize(static_cast<std::size_t>(box.count()));
    std::vector<float*> planes(volume.channel_names.size(), nullptr);
    planes[channel] = slot.values.data();
    voxels.fill(box, planes);
    round_values(slot.values.data(), slot.values.size(), volume.pixel_type);
    switch (nvdb_grid_type(volume.pixel_type)) {
        case nanovdb::GridType::Fp8:
            return make_leaves(volume, box, CodedLeaves<nanovdb::Fp8>{}, slot);
        case nanovdb::GridType::Fp16:
            return make_leaves(volume, box, CodedLeaves<nanovdb::Fp16>{}, slot);
        default:
            return make_leaves(volume, box, FloatLeaves{}, slot);
    }
}

}  // namespace skybake
