// Makes the leaves of one lower node of a NanoVDB grid: a box of at most 128 x 128 x 128 voxels.
// Boxes are independent of each other, so any thread may make one.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string_view>
#include <vector>

#include "bakers/field/level.h"
#include "bakers/io/formats/nvdb/nvdb_layout.h"
#include "bakers/io/formats/vdb/vdb_tree.h"
#include "bakers/math/memory.h"

namespace skybake {

struct Baked;

// The active voxels of some nodes.
struct NvdbActive : VdbActiveVoxels {
    float least = std::numeric_limits<float>::infinity();
    float largest = -std::numeric_limits<float>::infinity();

    void add(const NvdbActive& part);
};

// A lower node, apart from the leaves themselves.
struct NvdbLowerNode {
    std::array<std::uint64_t, 64> children{};  // bit n: the node has child n
    NvdbActive active;
    std::uint64_t first_leaf = 0;  // of the grid
    std::uint32_t leaves = 0;
};

struct NvdbSlot {
    AlignedFloats values;
    std::vector<NvdbUnit> memory;
    std::string_view leaves;  // as the file has them, in `memory`
    NvdbLowerNode node;
};

// Fills in slot.leaves and slot.node. In a sparse volume voxels that are stored as 0 or -0 are
// inactive, and leaves without active voxels are left out.
void make_nvdb_leaves(const Baked& volume, const Level& level, std::size_t channel,
                      const VoxelBox& box, NvdbSlot& slot);

}  // namespace skybake
