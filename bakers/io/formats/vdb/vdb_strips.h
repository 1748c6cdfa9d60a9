// Strips are the parts of a volume from which a VDB file is made: their voxels, which voxels are
// active, and their bytes. Strips are independent of each other, so any thread may make one.
#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <vector>

#include "bakers/field/level.h"
#include "bakers/io/formats/vdb/vdb_codec.h"
#include "bakers/io/formats/vdb/vdb_tree.h"
#include "bakers/math/memory.h"
#include "config/diagnostics/diagnostic.h"

namespace skybake {

struct Baked;

// Returns the strips of a volume in the order of its tree, node after node.
std::vector<VoxelBox> vdb_strips(const std::array<int, 3>& size);

// The memory for a strip, and its results.
struct VdbStripSlot {
    AlignedFloats values;
    VdbLeaves leaves;  // leaves with active voxels
    VdbStrip encoded;
    std::optional<config::Diagnostic> error;
};

class VdbStripMaker {
  public:
    VdbStripMaker(const Baked& volume, const Level& level, const VdbCodec& codec,
                  const std::filesystem::path& path);

    VdbEncoding encoding() const { return encoding_; }

    // Fills in slot.values and slot.leaves, or slot.error: E0401 for a voxel that is NaN or
    // infinite, E0402 for one that rounds to an infinite half. Throws what the volume's source
    // throws.
    void evaluate(const VoxelBox& strip, std::size_t channel, VdbStripSlot& slot) const;
    // Fills in slot.encoded from slot.values and slot.leaves.
    void encode(const VoxelBox& strip, VdbStripSlot& slot) const;

  private:
    [[nodiscard]] std::optional<config::Diagnostic> unstorable_voxel(const AlignedFloats& values,
                                                                     const VoxelBox& strip,
                                                                     std::size_t channel) const;

    const Baked& volume_;
    const Level& level_;
    const VdbCodec& codec_;
    const std::filesystem::path& path_;
    const VdbEncoding encoding_;
};

}  // namespace skybake
