#include "tests/support/cell_range_reference.h"

#include <algorithm>
#include <limits>

#include "bakers/occupancy/cell_grid.h"
#include "bakers/occupancy/exact_extremes.h"
#include "config/assets/occupancy_filter.h"

namespace skybake::occupancy {
namespace {

using config::OccupancyFilter;

// Positions on an axis at which to look, in voxel units.
std::vector<double> positions_of(Span cell, OccupancyFilter filter) {
    std::vector<double> positions;
    for (int i = cell.first; i < cell.last; ++i) positions.push_back(i + 0.5);
    if (filter == OccupancyFilter::trilinear) {
        positions.push_back(cell.first);
        positions.push_back(cell.last);
    }
    if (filter == OccupancyFilter::tricubic) {
        for (const double beyond : {0.5, 1.5}) {
            positions.push_back(cell.first - beyond);
            positions.push_back(cell.last + beyond);
        }
    }
    return positions;
}

double value_at(const float* voxels, const CellGrid& grid, OccupancyFilter filter, double x,
                double y, double z) {
    const OccupancyFilter lookup =
        filter == OccupancyFilter::trilinear ? filter : OccupancyFilter::nearest;
    const AxisTaps along_x = filter_taps(lookup, x, grid.voxels[0], true);
    const AxisTaps along_y = filter_taps(lookup, y, grid.voxels[1], true);
    const AxisTaps along_z = filter_taps(lookup, z, grid.voxels[2], false);
    double sum = 0;
    for (std::size_t i = 0; i < 8; ++i) {
        const std::array<std::size_t, 3> tap = {i & 1, i >> 1 & 1, i >> 2};
        const double voxel = voxels[index_of(grid.voxels, along_x.voxel[tap[0]],
                                             along_y.voxel[tap[1]], along_z.voxel[tap[2]])];
        sum += along_x.weight[tap[0]] * along_y.weight[tap[1]] * along_z.weight[tap[2]] * voxel;
    }
    return sum;
}

}  // namespace

CellRanges cell_ranges_reference(const float* voxels, const CellGrid& grid,
                                 OccupancyFilter filter) {
    CellRanges ranges{grid.size(), {}, {}};
    for (int k = 0; k < ranges.size[2]; ++k) {
        for (int j = 0; j < ranges.size[1]; ++j) {
            for (int i = 0; i < ranges.size[0]; ++i) {
                double least = std::numeric_limits<double>::infinity();
                double most = -least;
                for (const double z : positions_of(grid.voxels_of(2, k), filter)) {
                    for (const double y : positions_of(grid.voxels_of(1, j), filter)) {
                        for (const double x : positions_of(grid.voxels_of(0, i), filter)) {
                            const double value = value_at(voxels, grid, filter, x, y, z);
                            least = std::min(least, value);
                            most = std::max(most, value);
                        }
                    }
                }
                ranges.minimum.push_back(rounded_down(least));
                ranges.maximum.push_back(rounded_up(most));
            }
        }
    }
    return ranges;
}

}  // namespace skybake::occupancy
