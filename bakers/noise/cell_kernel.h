// Cellular noise on boxes of voxels, exact.
//
// A block of voxels smaller than a cell is near few of the points around it. Its candidates are the
// points of the cells about the block; the greatest distance from the block to its nearest point
// bounds F1 for all its voxels, so that points which are farther than that from the whole block are
// dropped, and tells whether points beyond the candidates' cells could matter; if so, the next ring
// of cells is asked too (two rings always suffice: F1 and F2 are at most sqrt(3)). For the few
// points left, squared distances are sums of three parts, of which only the one along z changes
// inside the innermost loop. Equals noise_specification.h bit for bit: a minimum does not depend on
// who else was looked at.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "bakers/field/baked.h"
#include "bakers/math/memory.h"
#include "bakers/noise/lattice_hash.h"
#include "bakers/noise/noise_plan.h"

namespace skybake::noise {

// The points about one block of voxels and their distances, in vectors' memory.
struct CellCandidates {
    static constexpr int kMost = 1024;
    static constexpr int kDepth = 8;  // slices of a block at most
    // Not a power of two, so that the slices' rows do not share a set of the cache.
    static constexpr std::size_t kSliceStride = kMost + 2 * kLanePadding;
    CellCandidates();
    // Per candidate: its place in its cell and that cell, counted from the block's first.
    AlignedFloats point_x, point_y, point_z, cell_x, cell_y, cell_z;
    AlignedFloats lower;      // least squared distance from the block
    AlignedFloats squared_x;  // [candidate][lane] squared distance along x
    AlignedFloats squared_z;  // [slice][candidate] along z
};

// The points of the cells of chunks within `box`, of at most `chunk_depth` slices, and of two rings
// of cells about them.
LatticePlanes make_cell_planes(const CellField& field, const VoxelBox& box, int chunk_depth);

// The field over the chunk's voxels: out[(z * chunk.size[1] + y) * row_stride + x]. row_stride is a
// multiple of kLanePadding, the ends of rows are overwritten. The field has at most one cell a
// voxel.
void fill_cell_field(const CellField& field, const VoxelBox& chunk, std::size_t row_stride,
                     LatticePlanes& planes, CellCandidates& candidates, float* out);

}  // namespace skybake::noise
