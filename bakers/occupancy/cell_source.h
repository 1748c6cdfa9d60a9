// One level of an occupancy grid as a volume: a voxel of it is a cell.
#pragma once

#include <cstdint>
#include <vector>

#include "bakers/field/baked.h"
#include "bakers/occupancy/cell_range.h"
#include "bakers/occupancy/occupied_cells.h"
#include "config/assets/occupancy.h"
#include "config/sections/files.h"

namespace skybake::occupancy {

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
