// Fills boxes of voxels with cellular noise whose cells are so narrow that dropping points costs
// more than looking at them, exactly.
//
// A tile is a vector of voxels along x, in any cells, times some rows and slices that lie in one
// cell along y and z. All its voxels look at the points of the same nine rows of cells, three
// points of each. What a point adds to squared distances along y and z is made once per point and
// row or slice of voxels and looked up by lanes; what it adds along x is shared by the tile. Where
// a voxel's nearest points are farther away than the cells that were not looked at, its vector is
// made again with another ring of cells.
#pragma once

#include "bakers/field/level.h"
#include "bakers/math/memory.h"
#include "bakers/noise/cell_kernel.h"
#include "bakers/noise/lattice_hash.h"
#include "bakers/noise/noise_plan.h"

namespace skybake::noise {

// Squared distances of a tile's rows and slices from points, reused from call to call.
struct NarrowCellScratch {
    AlignedFloats squares;
};

// Writes the field over the chunk's voxels, with planes that make_cell_planes made. The field has at
// most one cell per voxel.
void fill_narrow_cells(const CellField& field, const VoxelBox& chunk, LatticePlanes& planes,
                       NarrowCellScratch& scratch, const CellTarget& target);

}  // namespace skybake::noise
