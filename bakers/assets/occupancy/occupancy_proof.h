// The baker's proof of its own grid, by other means than it was made with: every cell that is
// called empty is looked at again.
#pragma once

#include <array>
#include <optional>

#include "bakers/math/bake_options.h"
#include "bakers/occupancy/cell_range.h"
#include "bakers/occupancy/occupied_cells.h"
#include "config/assets/occupancy.h"

namespace skybake::occupancy {

// An empty cell in which a lookup can be above the threshold.
struct LostCell {
    std::array<int, 3> cell{};
    double value = 0;
};

// The lost cell of the least index, or none. A cell is proved empty where none of the voxels that
// its lookups use is above the threshold; where one is, by the interpolant at every node of the
// cell, in double (cell_range.h says why that is enough); tricubic by the former alone. None, too,
// once options.progress is cancelled.
std::optional<LostCell> find_lost_cell(const ChannelSource& source, const CellGrid& grid,
                                       config::OccupancyFilter filter, const OccupiedCells& cells,
                                       float threshold, const BakeOptions& options);

}  // namespace skybake::occupancy
