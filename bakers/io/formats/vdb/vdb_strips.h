// Strips are the parts of a volume from which a VDB file is made: their voxels, which voxels are
// active, and their bytes. Strips are independent of each other, so any thread may make one.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "bakers/field/level.h"
#include "bakers/io/formats/vdb/vdb_codec.h"
#include "bakers/io/formats/vdb/vdb_tree.h"
#include "bakers/math/memory.h"
#include "config/diagnostics/diagnostic.h"

namespace skybake {

// Returns the strips of a volume in the order of its tree, node after node.
std::vector<VoxelBox> vdb_strips(const std::array<int, 3>& size);

// The memory for a strip, and its results.
struct VdbStripSlot {
    AlignedFloats values;
    VdbLeaves leaves;  // leaves with active voxels
    VdbStrip encoded;
    std::optional<config::Diagnostic> error;
};

}  // namespace skybake
