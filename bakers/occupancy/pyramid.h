// Coarser levels of occupancy grids: each cell is the union of 2 x 2 x 2 of the level below, fewer
// at the upper ends of odd sizes.
#pragma once

#include <array>

#include "bakers/occupancy/cell_range.h"
#include "bakers/occupancy/occupied_cells.h"

namespace skybake::occupancy {

// Half as many cells along each axis, rounded up; 1 stays 1.
std::array<int, 3> next_level_size(const std::array<int, 3>& size);

// The least of the minima and the greatest of the maxima: bounds for all within, as majorants for
// delta tracking want them.
CellRanges next_level(const CellRanges& ranges);

// Occupied where one of the cells is.
OccupiedCells next_level(const OccupiedCells& cells);

}  // namespace skybake::occupancy
