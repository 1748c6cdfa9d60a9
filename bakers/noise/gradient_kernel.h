// Gradient noise on boxes of voxels, separably.
//
// Inside a lattice cell improved noise is a sum of products of functions of x, y and z alone
// (noise_plan.h). So the gradients are hashed once a lattice point, blended along z once a
// slice and along y once a row, and four products a voxel remain, whatever the frequency. Equals
// noise_specification.h bit for bit.
#pragma once

#include <cstdint>
#include <vector>

#include "bakers/field/baked.h"
#include "bakers/math/memory.h"
#include "bakers/noise/lattice_hash.h"
#include "bakers/noise/noise_plan.h"

namespace skybake::noise {

// The gradients that a box needs of one octave, and the blends made of them. What filling a box in
// chunks keeps from chunk to chunk, one thread at a time.
struct GradientLattice {
    LatticePlanes planes;
    // Blends along z of the slice at hand: [y][x].
    AlignedFloats blended_distance, blended_x, blended_y;
    // Blends along z and y of the rows at hand.
    AlignedFloats row_value, row_slope;
};

// One per octave, for chunks within `box` of at most `chunk_depth` slices.
std::vector<GradientLattice> make_gradient_lattices(const GradientStack& stack, const VoxelBox& box,
                                                    int chunk_depth);

inline constexpr int kRowsAtOnce = 8;

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

// The stack's sum over the chunk's voxels. Each octave has at most one cell a voxel.
void fill_gradient_stack(const GradientStack& stack, const VoxelBox& chunk,
                         std::vector<GradientLattice>& lattices, const SumTarget& target);

}  // namespace skybake::noise
