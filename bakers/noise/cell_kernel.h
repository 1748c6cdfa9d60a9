// Fills boxes of voxels with cellular noise, exactly.
//
// A block of voxels smaller than a cell is near only a few of the points around it. Its candidates
// are the points of the cells around the block. The greatest distance from the block to its nearest
// point bounds F1 for all its voxels, so that points farther than that from the whole block are
// dropped. The same bound tells whether points beyond the candidates' cells could matter; if so,
// the next ring of cells is included too (two rings always suffice: F1 and F2 are at most sqrt(3)).
// For the few remaining points squared distances are sums of three parts, of which only the one
// along z changes inside the innermost loop. The result equals noise_specification.h bit for bit: a
// minimum does not depend on which other points were examined.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "bakers/field/baked.h"
#include "bakers/math/memory.h"
#include "bakers/noise/lattice_hash.h"
#include "bakers/noise/noise_plan.h"

namespace skybake::noise {

// The candidate points of one block of voxels and their distances, in memory for vector loads.
struct CellCandidates {
    static constexpr int kMost = 1024;
    static constexpr int kDepth = 8;  // largest number of slices of a block
    // Not a power of two, so that the rows of different slices do not fall into the same set of the
    // cache.
    static constexpr std::size_t kSliceStride = kMost + 2 * kLanePadding;
    CellCandidates();
    // For each candidate, its place in its cell, and that cell, counted from the block's first.
    AlignedFloats point_x, point_y, point_z, cell_x, cell_y, cell_z;
    AlignedFloats lower;      // least squared distance from the block
    AlignedFloats squared_x;  // [candidate][lane]: squared distance along x
    AlignedFloats squared_z;  // [slice][candidate]: squared distance along z
};

// Makes the lattice for the points of the cells of chunks within `box`, of at most `chunk_depth`
// slices each, and of two rings of cells around them.
LatticePlanes make_cell_planes(const CellField& field, const VoxelBox& box, int chunk_depth);

// Writes the field over the chunk's voxels to out[(z * chunk.size[1] + y) * row_stride + x].
// row_stride is a multiple of kLanePadding; the padding at the ends of rows is overwritten. The
// field has at most one cell per voxel.
void fill_cell_field(const CellField& field, const VoxelBox& chunk, std::size_t row_stride,
                     LatticePlanes& planes, CellCandidates& candidates, float* out);

}  // namespace skybake::noise
