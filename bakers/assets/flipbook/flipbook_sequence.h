// The frames of a sequence, as a flipbook needs them: their voxels, and whether they are a loop.
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "bakers/field/baked.h"
#include "bakers/math/bake_options.h"
#include "config/assets/flipbook.h"
#include "config/diagnostics/diagnostic.h"
#include "config/sections/parameters.h"

namespace skybake {

// The values of a box, channel after channel.
using Layer = std::vector<float>;
Layer layer_of(const VoxelSource& source, const VoxelBox& box, std::size_t channels);

// Makes one frame of a sequence, whose recipe has been set to its time. It has one level, whose voxels
// are made on demand, and is neither surveyed nor measured.
Outcome<Baked> make_frame(const Parameters& at_its_time, const Bake& first,
                          const BakeOptions& options);

// All that it is made of must outlive it.
struct FlipbookSequence {
    const Parameters& parameters;
    const Bake& first;
    const config::FlipbookBake& asset;
    const BakeOptions& options;
    std::vector<std::shared_ptr<const VoxelSource>> voxels = {};
    Baked kind = {};     // the first frame
    bool loops = false;  // the frame after the last one is the first

    // Makes all frames, and the one after the last. Returns what the makers report.
    [[nodiscard]] std::vector<Diagnostic> read();

    std::array<int, 3> size() const;  // of the flipbook

    // Returns the range in which the values of each channel of the frames lie, but for a few.
    std::vector<std::array<double, 2>> usual_ranges() const;

  private:
    Layer shown_of(const Baked& frame) const;
};

// A slice of each frame, one above the other.
class FrameVoxels : public VoxelSource {
  public:
    FrameVoxels(std::vector<std::shared_ptr<const VoxelSource>> frames, int slice);
    void fill(const VoxelBox& box, const std::vector<float*>& channels) const override;
    bool is_empty(const VoxelBox& box) const override;

  private:
    VoxelBox slice_of(const VoxelBox& box) const;

    std::vector<std::shared_ptr<const VoxelSource>> frames_;
    int slice_;
};

}  // namespace skybake
