// Fills a box with a sum of octaves of gradient noise, chunk by chunk, by the kernel that suits each
// octave: gradient_kernel.h for the first ones, while voxels share lattice points, and scattered_kernel.h
// from the first octave on in which they do not, or for all octaves if samples are displaced.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "bakers/field/level.h"
#include "bakers/math/memory.h"
#include "bakers/noise/gradient_kernel.h"
#include "bakers/noise/noise_plan.h"
#include "bakers/noise/scattered_kernel.h"

namespace skybake::noise {

// Says how a box is cut into chunks: the rows of all arrays over a chunk have this stride.
struct ChunkLayout {
    std::size_t row_stride = 0;
    std::size_t floats = 0;  // of the largest chunk
    int depth = 0;           // the greatest number of slices
    bool pointwise = false;  // the box has too few voxels for kernels that share work
};

class StackFiller {
  public:
    // The stack must outlive the filler.
    StackFiller(const GradientStack& stack, const std::array<TileAxis, 3>& axes,
                const VoxelBox& box, const ChunkLayout& layout, bool displaced);

    // True if fill writes rows of any stride, straight to where they are wanted.
    bool is_separable() const { return lattices_.size() == stack_.octaves.size(); }

    // Unless the filler is separable, the target's rows are those of the layout. `displaced` has
    // rows if the filler was made for displaced samples.
    void fill(const VoxelBox& chunk, const DisplacedRows& displaced, const SumTarget& target);

  private:
    const GradientStack& stack_;
    std::size_t row_stride_ = 0;
    bool displaced_ = false;
    std::vector<GradientLattice> lattices_;  // of the first octaves
    ScratchFloats octave_;
};

// The displacement of a chunk's samples.
class WarpFiller {
  public:
    // The warp must outlive the filler.
    WarpFiller(const WarpPlan& warp, const std::array<TileAxis, 3>& axes, const VoxelBox& box,
               const ChunkLayout& layout);
    void fill(const VoxelBox& chunk);
    DisplacedRows rows();

  private:
    std::size_t row_stride_ = 0;
    std::vector<StackFiller> stacks_;
    std::array<ScratchFloats, 3> along_;
};

}  // namespace skybake::noise
