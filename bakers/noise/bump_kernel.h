// Fills boxes of voxels with alligator noise that is not displaced, exactly, where cells are wide.
//
// A bump ends one cell from its point. So of the points about a block of voxels only those matter
// that are less than a cell away from it, a handful where the block is smaller than a cell, and all
// voxels of the block share them. The result equals noise_specification.h bit for bit: the two
// greatest bumps do not depend on the order of the points, nor on bumps that have ended.
#pragma once

#include "bakers/field/level.h"
#include "bakers/math/memory.h"
#include "bakers/noise/cell_kernel.h"
#include "bakers/noise/lattice_hash.h"
#include "bakers/noise/noise_plan.h"

namespace skybake::noise {

// The points of a block and their squared distances, reused from call to call.
struct BumpScratch {
    AlignedFloats squared_x;  // [point][lane]
};

// Makes the lattice for chunks within `box` of at most `chunk_depth` slices.
LatticePlanes make_bump_planes(const CellField& field, const VoxelBox& box, int chunk_depth);

// Returns whether cells are so wide that sharing points pays: four voxels or more along each axis.
bool has_wide_bumps(const CellField& field);

// Writes the field, which has wide bumps, over the chunk's voxels.
void fill_bumps(const CellField& field, const VoxelBox& chunk, LatticePlanes& planes,
                BumpScratch& scratch, const CellTarget& target);

}  // namespace skybake::noise
