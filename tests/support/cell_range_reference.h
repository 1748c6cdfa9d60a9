// The definition of cell_range.h, slowly: what tests hold the kernels against.
#pragma once

#include "bakers/occupancy/cell_range.h"
#include "config/assets/occupancy_filter.h"

namespace skybake::occupancy {

// Looks up every node of every cell (trilinear), or looks at every voxel of its footprint.
// Sums are in double: exact, like cell_ranges, where the magnitudes of voxels that are not 0 are
// within a factor of 2^26 of each other, else to a unit in the last place.
CellRanges cell_ranges_reference(const float* voxels, const CellGrid& grid,
                                 config::OccupancyFilter filter);

}  // namespace skybake::occupancy
