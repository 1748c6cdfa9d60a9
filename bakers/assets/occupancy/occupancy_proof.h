// The baker's proof of its own grid, by a method other than the one that made it: every cell that
// is called empty is examined again.
#pragma once

#include <array>
#include <optional>

#include "bakers/math/bake_options.h"
#include "bakers/occupancy/cell_range.h"
#include "bakers/occupancy/occupied_cells.h"
#include "config/assets/occupancy_filter.h"

namespace skybake::occupancy {

// An empty cell in which a lookup can be above the threshold.
struct LostCell {
    std::array<int, 3> cell{};
    double value = 0;
};

// Returns the lost cell with the least index, or nothing. A cell is proved empty if none of the
// voxels that its lookups use is above the threshold. Where one is, the interpolant must not be
// above it at any node of the cell, in double (cell_range.h explains why that is sufficient); this
// second test does not exist for tricubic. Returns nothing, too, once options.progress is
// cancelled.
std::optional<LostCell> find_lost_cell(const ChannelSource& source, const CellGrid& grid,
                                       config::OccupancyFilter filter, const OccupiedCells& cells,
                                       float threshold, const BakeOptions& options);

}  // namespace skybake::occupancy
