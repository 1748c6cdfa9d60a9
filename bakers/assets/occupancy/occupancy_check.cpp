#include "bakers/assets/occupancy/occupancy_check.h"

#include <algorithm>
#include <cmath>

#include "bakers/math/low_discrepancy.h"
#include "config/assets/occupancy.h"

namespace skybake::occupancy {

namespace {

// As many as the widest filter uses.
constexpr int kPlanes = 4;

}  // namespace

OccupancyCheck::OccupancyCheck(const CellGrid& grid, const std::vector<std::uint8_t>& occupied,
                               config::OccupancyFilter filter, float threshold, int channel,
                               int channels, int points)
    : grid_(grid),
      cells_(grid.size()),
      occupied_(occupied),
      filter_(filter),
      threshold_(threshold),
      channel_(static_cast<std::size_t>(channel)),
      channels_(static_cast<std::size_t>(channels)),
      planes_(count_of({grid.voxels[0], grid.voxels[1], kPlanes})) {
    sort_points(points);
}

std::array<double, 3> OccupancyCheck::place_of(int point) const {
    std::array<double, 3> place = low_discrepancy_point(point);
    for (std::size_t a = 0; a < 3; ++a) place[a] *= grid_.voxels[a];
    return place;
}

std::array<AxisTaps, 3> OccupancyCheck::taps_at(const std::array<double, 3>& place) const {
    std::array<AxisTaps, 3> taps;
    for (std::size_t a = 0; a < 3; ++a) {
        taps[a] = filter_taps(filter_, place[a], grid_.voxels[a], a < 2);
    }
    return taps;
}

// Counts the points of each plane, then puts them in its place.
void OccupancyCheck::sort_points(int points) {
    const auto last_plane = [&](int point) {
        const AxisTaps taps = filter_taps(filter_, place_of(point)[2], grid_.voxels[2], false);
        return static_cast<std::size_t>(taps.voxel[static_cast<std::size_t>(taps.count - 1)]);
    };
    std::vector<std::size_t> next(static_cast<std::size_t>(grid_.voxels[2]) + 1);
    for (int point = 0; point < points; ++point) ++next[last_plane(point) + 1];
    for (std::size_t z = 1; z < next.size(); ++z) next[z] += next[z - 1];
    points_.resize(static_cast<std::size_t>(points));
    for (int point = 0; point < points; ++point) points_[next[last_plane(point)]++] = point;
    ends_ = next;
}

float* OccupancyCheck::plane(int z) {
    return planes_.data() + index_of(grid_.voxels, 0, 0, z % kPlanes);
}

void OccupancyCheck::add(std::int64_t first, std::int64_t count, const float* values) {
    const std::int64_t area = std::int64_t{grid_.voxels[0]} * grid_.voxels[1];
    const std::int64_t end = first + count;
    while (first < end) {
        const auto z = static_cast<int>(first / area);
        const std::int64_t piece = std::min(end, (z + 1) * area) - first;
        float* target = plane(z) + first % area;
        for (std::int64_t i = 0; i < piece; ++i, values += channels_) {
            target[i] = values[channel_];
        }
        first += piece;
        if (first % area == 0) look_at_points(z);
    }
}

void OccupancyCheck::look_at_points(int z) {
    const auto index = static_cast<std::size_t>(z);
    for (std::size_t i = index == 0 ? 0 : ends_[index - 1]; i < ends_[index]; ++i) {
        look_at(points_[i]);
    }
}

void OccupancyCheck::look_at(int point) {
    ++result_.points;
    const std::array<double, 3> place = place_of(point);
    std::array<int, 3> cell{};
    for (std::size_t a = 0; a < 3; ++a) cell[a] = static_cast<int>(place[a]) / grid_.cell;
    if (occupied_[index_of(cells_, cell[0], cell[1], cell[2])] != 0) return;
    const float value = filtered_value(taps_at(place), [&](int x, int y, int z) {
        return plane(z)[index_of(grid_.voxels, x, y, 0)];
    });
    if (!(value > threshold_)) return;
    if (result_.lost++ == 0 || value > result_.worst_value) {
        result_.worst_value = value;
        result_.place = place;
        result_.cell = cell;
    }
}

}  // namespace skybake::occupancy
