// The cells that a ray must sample, coarser levels of them, and an occupancy grid as a volume.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "bakers/field/level.h"
#include "bakers/math/bake_options.h"
#include "bakers/occupancy/cell_range.h"
#include "config/sections/pixel_types.h"

namespace skybake::config {
enum class OccupancyContent;
}  // namespace skybake::config

namespace skybake::occupancy {

struct OccupiedCells {
    std::array<int, 3> size{};           // cells along x, y, z
    std::vector<std::uint8_t> occupied;  // 1 or 0 per cell, x fastest, then y, then z
};

// Returns the share of cells that are occupied.
double occupied_share(const OccupiedCells& cells);

// Applies the exact rule: a cell is occupied where some filtered value in it is greater than the
// threshold, and for the filters nearest and trilinear only there. The threshold is 0 for
// densities, all of which count, and the runtime's threshold where that is applied after filtering.
// No visible value is lost.
OccupiedCells occupied_cells(const CellRanges& ranges, float threshold);

// Applies the rule of Olajos, "Real-time rendering of volumetric clouds", 2016: a cell is occupied
// if at least an eighth of its voxels (8 of 4^3) are greater than the threshold, which must not be
// negative, or if one of its 26 neighbours is, without wrapping. It is for comparison only: it
// loses thin parts of clouds.
OccupiedCells occupied_cells_as_in_thesis(const ChannelSource& source, const CellGrid& grid,
                                          float threshold, const BakeOptions& options);

// In coarser levels each cell is the union of 2 x 2 x 2 cells of the level below, fewer at the
// upper ends of odd sizes.

// Returns half as many cells along each axis, rounded up; 1 stays 1.
std::array<int, 3> next_level_size(const std::array<int, 3>& size);

// Returns the least minima and the greatest maxima: bounds for all cells within, as majorants for
// delta tracking require.
CellRanges next_level(const CellRanges& ranges);

// Returns cells that are occupied where any of their cells is.
OccupiedCells next_level(const OccupiedCells& cells);

// One level of an occupancy grid as a volume, with one voxel per cell.
class CellSource : public VoxelSource {
  public:
    // The channels are `contents`. Minima are rounded down and maxima up to what the pixel type can
    // hold. Leaps are in cells, or, stored as unorm, in units of 255 cells.
    CellSource(CellRanges ranges, OccupiedCells occupied,
               std::vector<config::OccupancyContent> contents, PixelType pixel_type);

    void fill(const VoxelBox& box, const std::vector<float*>& channels) const override;

    const CellRanges& ranges() const { return ranges_; }
    const OccupiedCells& occupied() const { return occupied_; }
    // Empty if no channel has them.
    const std::vector<std::uint8_t>& leaps() const { return leap_; }

  private:
    float value(config::OccupancyContent content, std::size_t cell) const;

    CellRanges ranges_;
    OccupiedCells occupied_;
    std::vector<std::uint8_t> leap_;
    std::vector<config::OccupancyContent> contents_;
    PixelType pixel_type_;
};

// The type stores [0, 1] as integers.
inline bool is_unorm(PixelType type) {
    return type == PixelType::unorm8 || type == PixelType::unorm16;
}

// Return the least value of the pixel type that is not below `value`, and the greatest that is not
// above it, for values that the type can hold.
float stored_up(float value, PixelType type);
float stored_down(float value, PixelType type);

}  // namespace skybake::occupancy
