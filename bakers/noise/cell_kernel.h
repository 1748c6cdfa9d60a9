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

#include "bakers/core/aligned_floats.h"
#include "bakers/core/volume.h"
#include "bakers/noise/noise_plan.h"

namespace skybake::noise {

// The points of the cells that a box needs, [plane of the ring][y][x]. It and the candidates are
// what filling a box in chunks keeps from chunk to chunk, one thread at a time.
struct CellLattice {
    std::array<std::int64_t, 3> first{};  // cell of the first point along x and y; z: of the box
    std::array<int, 3> count{};           // cells along x, y; planes held along z
    std::size_t stride = 0;
    std::vector<std::uint32_t> scaled_x;
    AlignedFloats x, y, z;  // where the point lies in its cell
    std::vector<std::int64_t> plane_of_slot;
};

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

// Chunks within `box`, of at most `chunk_depth` slices, can be filled with this.
CellLattice make_cell_lattice(const CellField& field, const VoxelBox& box, int chunk_depth);

// Whether this kernel takes the field: at most one cell a voxel along each axis.
bool is_blockwise(const CellField& field, const std::array<TileAxis, 3>& axes);

// The field over the chunk's voxels: out[(z * chunk.size[1] + y) * row_stride + x]. row_stride is a
// multiple of kLanePadding, the ends of rows are overwritten.
void fill_cell_field(const CellField& field, const VoxelBox& chunk, std::size_t row_stride,
                     CellLattice& lattice, CellCandidates& candidates, float* out);

}  // namespace skybake::noise
