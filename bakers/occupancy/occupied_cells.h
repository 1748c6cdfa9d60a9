// Which cells a ray must look into.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "bakers/math/bake_options.h"
#include "bakers/occupancy/cell_range.h"

namespace skybake::occupancy {

struct OccupiedCells {
    std::array<int, 3> size{};           // cells along x, y, z
    std::vector<std::uint8_t> occupied;  // 1 or 0 per cell, x fastest, then y, then z
};

// Of all cells.
double occupied_share(const OccupiedCells& cells);

// The exact rule: a cell is occupied where some filtered value in it is greater than the threshold,
// and only there if the filter is nearest or trilinear. 0 for densities, all of which count; the
// runtime's threshold where that comes after filtering. Nothing a ray could see is lost.
OccupiedCells occupied_cells(const CellRanges& ranges, float threshold);

// The rule of Olajos, "Real-time rendering of volumetric clouds", 2016: a cell is on if at least an
// eighth of its voxels (8 of 4^3) are greater than the threshold, which is not negative, or if one
// of its 26 neighbours is; without wrap. For comparison: it loses thin parts of clouds.
OccupiedCells occupied_cells_as_in_thesis(const float* voxels, const CellGrid& grid,
                                          float threshold, int threads = 1);
OccupiedCells occupied_cells_as_in_thesis(const ChannelSource& source, const CellGrid& grid,
                                          float threshold, const BakeOptions& options);

}  // namespace skybake::occupancy
