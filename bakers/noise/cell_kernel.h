// Fills boxes of voxels with cellular noise and alligator noise, exactly.
//
// A block of voxels smaller than a cell is near only a few of the points around it. Its candidates
// are the points of the cells around the block. The greatest distance from the block to its nearest
// point bounds F1 for all its voxels, so that points farther than that from the whole block are
// dropped. The same bound tells whether points beyond the candidates' cells could matter; if so,
// the next ring of cells is included too (two rings always suffice: F1 and F2 are at most sqrt(3)).
// For the few remaining points squared distances are sums of three parts, of which only the one
// along z changes inside the innermost loop. The result equals tests/noise/noise_specification.h bit
// for bit: a minimum does not depend on which other points were examined.
#pragma once

#include <array>

#include "bakers/field/level.h"
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
    static constexpr std::size_t kLineStride = kMost + 2 * kLanePadding;
    CellCandidates();
    // For each candidate, its place in its cell, and that cell, counted from the block's first.
    AlignedFloats point_x, point_y, point_z, cell_x, cell_y, cell_z;
    AlignedFloats lower;      // least squared distance from the block
    AlignedFloats squared_x;  // [candidate][lane]: squared distance along x
    AlignedFloats squared_y;  // [candidate]: squared distance along y, of one row
    AlignedFloats squared_z;  // [slice][candidate]: squared distance along z
};

// Describes where values are written: voxel (x, y, z) of a box with this origin goes to
// out[(z - origin z) * slice_stride + (y - origin y) * row_stride + (x - origin x)]. Rows are
// written in whole vectors of up to kLanePadding floats, which overwrites the memory between the
// end of a row and the next.
struct CellTarget {
    float* out = nullptr;
    std::array<int, 3> origin{};
    std::size_t row_stride = 0;
    std::size_t slice_stride = 0;
    float* at(int x, int y, int z) const {
        return out + (static_cast<std::size_t>(z - origin[2]) * slice_stride +
                      static_cast<std::size_t>(y - origin[1]) * row_stride +
                      static_cast<std::size_t>(x - origin[0]));
    }
};

// Makes the lattice for the points of the cells of chunks within `box`, of at most `chunk_depth`
// slices each, and of two rings of cells around them.
LatticePlanes make_cell_planes(const CellField& field, const VoxelBox& box, int chunk_depth);

double voxels_per_cell(const CellField& field, std::size_t axis);

// True if dropping points for whole blocks pays: where blocks are smaller than cells. The bounds are
// the best of those tried.
bool has_wide_cells(const CellField& field);

// Writes the field, which has wide cells, over the chunk's voxels.
void fill_wide_cells(const CellField& field, const VoxelBox& chunk, LatticePlanes& planes,
                     CellCandidates& candidates, const CellTarget& target);

// --- Narrow cells --------------------------------------------------------------------------------

// Fills boxes of voxels with cellular noise whose cells are so narrow that dropping points costs
// more than looking at them, exactly.
//
// A tile is a vector of voxels along x, in any cells, times some rows and slices that lie in one
// cell along y and z. All its voxels look at the points of the same nine rows of cells, three
// points of each. What a point adds to squared distances along y and z is made once per point and
// row or slice of voxels and looked up by lanes; what it adds along x is shared by the tile. Where
// a voxel's nearest points are farther away than the cells that were not looked at, its vector is
// made again with another ring of cells.

// Writes the field over the chunk's voxels, with planes that make_cell_planes made. The field has at
// most one cell per voxel. `squares` is room for squared distances of a tile's rows and slices from
// points, reused from call to call.
void fill_narrow_cells(const CellField& field, const VoxelBox& chunk, LatticePlanes& planes,
                       AlignedFloats& squares, const CellTarget& target);

// --- Bumps ----------------------------------------------------------------------------------------

// Fills boxes of voxels with alligator noise that is not displaced, exactly, where cells are wide.
//
// A bump ends one cell from its point. So of the points about a block of voxels only those matter
// that are less than a cell away from it, a handful where the block is smaller than a cell, and all
// voxels of the block share them. The result equals tests/noise/noise_specification.h bit for bit:
// the two greatest bumps do not depend on the order of the points, nor on bumps that have ended.

// Makes the lattice for chunks within `box` of at most `chunk_depth` slices.
LatticePlanes make_bump_planes(const CellField& field, const VoxelBox& box, int chunk_depth);

// Returns whether cells are so wide that sharing points pays: four voxels or more along each axis.
bool has_wide_bumps(const CellField& field);

// Writes the field, which has wide bumps, over the chunk's voxels. `squared_x` is room for squared
// distances along x of a block's points, [point][lane], reused from call to call.
void fill_bumps(const CellField& field, const VoxelBox& chunk, LatticePlanes& planes,
                AlignedFloats& squared_x, const CellTarget& target);

}  // namespace skybake::noise
