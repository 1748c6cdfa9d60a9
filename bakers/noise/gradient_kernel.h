// Fills boxes of voxels with gradient noise, one axis after the other.
//
// Inside a lattice cell improved noise is a sum of products of functions of x, y and z alone
// (noise_plan.h). So gradients are hashed once per lattice point, blended along z once per slice
// and along y once per row, and four products per voxel remain, whatever the frequency. The result
// equals tests/noise/noise_specification.h bit for bit.
#pragma once

#include <vector>

#include "bakers/field/level.h"
#include "bakers/math/memory.h"
#include "bakers/noise/lattice_hash.h"
#include "bakers/noise/noise_plan.h"

namespace skybake::noise {

// Sums are made for so many rows at a time, in pieces of so many voxels. A row of blends has a value
// for each lattice point, and kSlopes floats further a slope.
inline constexpr int kRowsAtOnce = 8;
inline constexpr int kVoxelsAtOnce = 256;
inline constexpr std::size_t kSlopes = kVoxelsAtOnce + 2 * kLanePadding;
inline constexpr std::size_t kBlendStride = 2 * kSlopes;

// The gradients of one octave that a box needs, and the blends made of them. They are kept from
// chunk to chunk while a box is filled, by one thread at a time.
struct GradientLattice {
    LatticePlanes planes;
    // Blends along z for the current slice: [y][x].
    AlignedFloats blended_distance, blended_x, blended_y;
    AlignedFloats rows;  // blends along z and y for kRowsAtOnce rows of voxels
};

// Makes one lattice for each of the first `octaves` octaves, for chunks within `box` of at most
// `chunk_depth` slices.
std::vector<GradientLattice> make_gradient_lattices(const GradientStack& stack, std::size_t octaves,
                                                    const VoxelBox& box, int chunk_depth);

// Describes where sums are written: voxel (x, y, z) of a chunk goes to out[z * slice_stride + y *
// row_stride + x], multiplied by scale plus offset. Rows are written in whole vectors of up to
// kLanePadding floats, in the order of y, then z, which overwrites the memory between the end of a
// row and the next.
struct SumTarget {
    float* out = nullptr;
    std::size_t row_stride = 0;
    std::size_t slice_stride = 0;
    float scale = 1;
    float offset = 0;
    bool finishes() const { return scale != 1 || offset != 0; }
};

// Writes the sum of the octaves that have lattices over the chunk's voxels. Each of them has at most
// one cell per voxel.
void fill_gradient_stack(const GradientStack& stack, const VoxelBox& chunk,
                         std::vector<GradientLattice>& lattices, const SumTarget& target);

}  // namespace skybake::noise
