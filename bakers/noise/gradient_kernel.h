// Gradient noise on boxes of voxels, separably.
//
// Inside a lattice cell improved noise is a sum of products of functions of x, y and z alone
// (gradient_basis.h). So the gradients are hashed once a lattice point, blended along z once a
// slice and along y once a row, and four products a voxel remain, whatever the frequency. Equals
// noise_specification.h bit for bit.
#pragma once

#include <cstdint>
#include <vector>

#include "bakers/core/aligned_floats.h"
#include "bakers/core/volume.h"
#include "bakers/noise/noise_plan.h"

namespace skybake::noise {

// The lattice points of one octave that a box needs, and the blends made of them.
struct GradientLattice {
    std::array<std::int64_t, 3> first{};  // lattice coordinates of the first point
    std::array<int, 3> count{};           // points along x, y; planes held along z
    std::size_t stride = 0;               // floats from row to row, with room for a vector to spare
    std::vector<std::uint32_t> scaled_x;  // of each point along x, wrapped, for its hash
    // Gradients: [plane of the ring][y][x].
    AlignedFloats x, y, z;
    std::vector<std::int64_t> plane_of_slot;
    // Blends along z of the slice at hand: [y][x].
    AlignedFloats blended_distance, blended_x, blended_y;
    // Blends along z and y of the rows at hand.
    AlignedFloats row_value, row_slope;
};

// What filling a box in chunks keeps from chunk to chunk. One thread at a time.
class GradientScratch {
  public:
    // Chunks within `box`, of at most `chunk_depth` slices, can be filled with this.
    GradientScratch(const GradientStack& stack, const VoxelBox& box, int chunk_depth);
    std::vector<GradientLattice>& lattices() { return lattices_; }

  private:
    std::vector<GradientLattice> lattices_;
};

inline constexpr int kRowsAtOnce = 8;

// Whether the separable kernel takes the octave: at most one cell a voxel along each axis.
bool is_separable(const GradientOctave& octave, const std::array<TileAxis, 3>& axes);

// Where sums go: voxel (x, y, z) of a chunk to out[z * slice_stride + y * row_stride + x], times
// scale plus offset. Rows are written in whole vectors of up to kLanePadding floats, in the order
// of y, then z: what lies between the end of a row and the next is overwritten.
struct SumTarget {
    float* out = nullptr;
    std::size_t row_stride = 0;
    std::size_t slice_stride = 0;
    float scale = 1;
    float offset = 0;
    bool finishes() const { return scale != 1 || offset != 0; }
};

// The stack's sum over the chunk's voxels.
void fill_gradient_stack(const GradientStack& stack, const VoxelBox& chunk,
                         GradientScratch& scratch, const SumTarget& target);

}  // namespace skybake::noise
