// The parts of a volume from which VDB files are made: their voxels, which of them are active, and
// their bytes. Strips are independent of each other; any thread may make one.
#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <vector>

#include "bakers/field/baked.h"
#include "bakers/io/formats/vdb/vdb_codec.h"
#include "bakers/io/formats/vdb/vdb_tree.h"
#include "bakers/math/memory.h"
#include "config/diagnostics/diagnostic.h"

namespace skybake {

// The strips of a volume in the order of its tree: node after node.
std::vector<VoxelBox> vdb_strips(const std::array<int, 3>& size);

// Memory for a strip, and what became of it.
struct VdbStripSlot {
    AlignedFloats values;
    VdbLeaves leaves;  // the active ones
    VdbStrip encoded;
    std::optional<config::Diagnostic> error;
};

class VdbStripMaker {
  public:
    VdbStripMaker(const Baked& volume, const Level& level, const VdbCodec& codec,
                  const std::filesystem::path& path);

    VdbEncoding encoding() const { return encoding_; }

    // Fills slot.values and slot.leaves, or slot.error: E0401 for a voxel that is NaN or infinite,
    // E0402 for one that rounds to an infinite half. Throws what the volume's source throws.
    void evaluate(const VoxelBox& strip, std::size_t channel, VdbStripSlot& slot) const;
    // Fills slot.encoded from those.
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
