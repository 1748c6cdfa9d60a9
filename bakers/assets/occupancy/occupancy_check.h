// Checks an occupancy grid on the voxels of a file: looks for filtered values above the threshold
// in cells that the grid calls empty.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "bakers/io/manifest/verify.h"
#include "bakers/occupancy/cell_grid.h"
#include "config/assets/occupancy_filter.h"

namespace skybake::occupancy {

struct OccupancyCheckResult {
    std::int64_t points = 0;        // number of points that were sampled
    std::int64_t lost = 0;          // how many of them are above the threshold in an empty cell
    float worst_value = 0;          // the greatest value that is lost
    std::array<double, 3> place{};  // its place in voxel units, voxel i from i to i + 1
    std::array<int, 3> cell{};      // the cell that contains it
};

// Takes the voxels of a volume once, in the order x, y, z, in pieces of any length. It samples the
// first `points` points of Roberts' sequence (low_discrepancy_point), each as soon as the planes
// around it have arrived. Memory: four planes of one channel, and four bytes per point.
class OccupancyCheck {
  public:
    // Checks channel `channel` of `channels` interleaved ones. `occupied` has a flag for each cell
    // of grid.size(), x fastest, and must outlive the check.
    OccupancyCheck(const CellGrid& grid, const std::vector<std::uint8_t>& occupied,
                   config::OccupancyFilter filter, float threshold, int channel, int channels,
                   int points = 1000000);

    // Adds voxels first to first + count - 1, which must follow those added before.
    void add(std::int64_t first, std::int64_t count, const float* values);

    // The result, valid after all voxels have been added.
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

// Returns a check of the occupancy grids of a folder. For each grid of a manifest that also has its
// volume, it draws 10^6 filtered samples from the stored voxels; a sample above the threshold in a
// cell that the stored grid calls empty is a failure. A grid without the channels that tell which
// cells are empty (occupied, leap or maximum) is not checked.
FolderCheck skipping_check();

}  // namespace skybake
