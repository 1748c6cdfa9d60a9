// Which cells a ray must look into.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "bakers/field/baked.h"
#include "bakers/math/bake_options.h"
#include "bakers/occupancy/cell_range.h"
#include "config/assets/occupancy.h"
#include "config/sections/files.h"

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

// Coarser levels of occupancy grids: each cell is the union of 2 x 2 x 2 of the level below, fewer
// at the upper ends of odd sizes.

// Half as many cells along each axis, rounded up; 1 stays 1.
std::array<int, 3> next_level_size(const std::array<int, 3>& size);

// The least of the minima and the greatest of the maxima: bounds for all within, as majorants for
// delta tracking want them.
CellRanges next_level(const CellRanges& ranges);

// Occupied where one of the cells is.
OccupiedCells next_level(const OccupiedCells& cells);

// One level of an occupancy grid as a volume: a voxel of it is a cell.
class CellSource : public VoxelSource {
  public:
    // Channels are `contents`. Minima are rounded down and maxima up to what the pixel type holds.
    // Leaps are in cells; as unorm, in 255 cells.
    CellSource(CellRanges ranges, OccupiedCells occupied,
               std::vector<config::OccupancyContent> contents, config::PixelType pixel_type);

    void fill(const VoxelBox& box, const std::vector<float*>& channels) const override;

    const CellRanges& ranges() const { return ranges_; }
    const OccupiedCells& occupied() const { return occupied_; }

  private:
    float value(config::OccupancyContent content, std::size_t cell) const;

    CellRanges ranges_;
    OccupiedCells occupied_;
    std::vector<std::uint8_t> leap_;  // none where no channel has it
    std::vector<config::OccupancyContent> contents_;
    config::PixelType pixel_type_;
};

// The least value of the pixel type that is not below `value`, and the greatest not above it; of
// values that the type can hold.
float stored_up(float value, config::PixelType type);
float stored_down(float value, config::PixelType type);

}  // namespace skybake::occupancy
