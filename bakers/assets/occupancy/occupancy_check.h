// Proves an occupancy grid on the voxels of a file: looks for filtered values in cells that it says
// are empty.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "bakers/io/manifest/verify.h"
#include "bakers/occupancy/cell_grid.h"
#include "config/assets/occupancy.h"

namespace skybake::occupancy {

struct OccupancyCheckResult {
    std::int64_t points = 0;        // looked at
    std::int64_t lost = 0;          // of them: in an empty cell, above the threshold
    float worst_value = 0;          // the greatest of those lost
    std::array<double, 3> place{};  // where: in voxel units, voxel i from i to i + 1
    std::array<int, 3> cell{};      // which holds it
};

// Takes the voxels of a volume once, in the order x, y, z, in pieces of any length, and looks at
// the first so many points of Roberts' sequence (low_discrepancy_point) as soon as the planes about
// them are there. Memory: four planes of one channel and four bytes a point.
class OccupancyCheck {
  public:
    // Looks at channel `channel` of `channels` interleaved ones. `occupied` has grid.size() flags,
    // x fastest, and must outlive the check.
    OccupancyCheck(const CellGrid& grid, const std::vector<std::uint8_t>& occupied,
                   config::OccupancyFilter filter, float threshold, int channel, int channels,
                   int points = 1000000);

    // Voxels first ... first + count - 1, following those before.
    void add(std::int64_t first, std::int64_t count, const float* values);

    // After all voxels.
    const OccupancyCheckResult& result() const { return result_; }

  private:
    std::array<double, 3> place_of(int point) const;
    std::array<AxisTaps, 3> taps_at(const std::array<double, 3>& place) const;
    void sort_points(int points);
    void look_at_points(int plane);
    void look_at(int point);
    float* plane(int z);

    const CellGrid grid_;
    const std::array<int, 3> cells_;
    const std::vector<std::uint8_t>& occupied_;
    const config::OccupancyFilter filter_;
    const float threshold_;
    const std::size_t channel_;
    const std::size_t channels_;
    std::vector<float> planes_;      // a ring of four
    std::vector<int> points_;        // by the last plane that they need
    std::vector<std::size_t> ends_;  // of the points of each plane among them
    OccupancyCheckResult result_;
};

}  // namespace skybake::occupancy

namespace skybake {

// Whether the occupancy grids of a folder lose anything of the volumes that they are of.

// For each occupancy grid of a manifest that also has its volume: draws 10^6 filtered samples from
// the stored voxels; one that is something in a cell which the stored grid says is empty is a
// failure. A grid without the channels that say so (occupied, leap or maximum) is not checked.
FolderCheck skipping_check();

}  // namespace skybake
