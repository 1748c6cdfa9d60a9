#include "bakers/occupancy/cell_grid.h"

#include <cassert>
#include <cmath>

#include "config/assets/occupancy_filter.h"

namespace skybake::occupancy {
namespace {

using config::OccupancyFilter;

// Returns the weights of the voxels about a place, `f` of the way from the second centre to the third.
std::array<double, 4> spline_weights(double f) {
    const double g = 1 - f;
    return {g * g * g / 6, (4 + 3 * f * f * (f - 2)) / 6, (4 + 3 * g * g * (g - 2)) / 6,
            f * f * f / 6};
}

}  // namespace

AxisTaps filter_taps(OccupancyFilter filter, double position, int size, bool repeats) {
    assert(size >= 1);
    AxisTaps taps;
    const double from_centre = filter == OccupancyFilter::nearest ? position : position - 0.5;
    const double below = std::floor(from_centre);
    const double f = from_centre - below;
    auto first = static_cast<int>(below);
    switch (filter) {
        case OccupancyFilter::nearest:
            taps.count = 1;
            taps.weight = {1};
            break;
        case OccupancyFilter::trilinear:
            taps.count = 2;
            taps.weight = {1 - f, f};
            break;
        case OccupancyFilter::tricubic:
            taps.count = 4;
            taps.weight = spline_weights(f);
            first -= 1;
            break;
    }
    for (int i = 0; i < taps.count; ++i) {
        taps.voxel[static_cast<std::size_t>(i)] =
            repeats ? wrapped(first + i, size) : clamped(first + i, size);
    }
    return taps;
}

int voxels_beyond(config::OccupancyFilter filter) {
    switch (filter) {
        case config::OccupancyFilter::nearest:
            return 0;
        case config::OccupancyFilter::trilinear:
            return 1;
        case config::OccupancyFilter::tricubic:
            break;
    }
    return 2;
}

}  // namespace skybake::occupancy
