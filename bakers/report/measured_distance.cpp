#include "bakers/report/measured_distance.h"

#include <algorithm>
#include <cstddef>

#include "bakers/assets/cloud_distance/cloud_distance.h"
#include "bakers/field/pixel_type.h"
#include "bakers/occupancy/distance_volume.h"
#include "bakers/occupancy/nearest_voxel.h"
#include "config/assets/occupancy_filter.h"

namespace skybake {

namespace {

std::array<double, 3> voxel_edges_of(const occupancy::MarchedVolume& volume) {
    std::array<double, 3> edges{};
    for (std::size_t a = 0; a < 3; ++a) edges[a] = volume.extent[a] / volume.grid.voxels[a];
    return edges;
}

}  // namespace

MeasuredDistance::MeasuredDistance(const std::vector<float>& voxels,
                                   const occupancy::MarchedVolume& volume,
                                   const config::CloudDistanceBake& bake)
    : volume_(volume),
      bake_(bake),
      voxel_m_(voxel_edges_of(volume)),
      code_(distance_code(bake, voxel_m_)),
      bits_(volume.grid.voxels) {
    const std::array<int, 3>& size = volume.grid.voxels;
    for (int z = 0; z < size[2]; ++z) {
        for (int y = 0; y < size[1]; ++y) {
            bits_.set_row(y, z, &voxels[occupancy::index_of(size, 0, y, z)], volume.threshold);
        }
    }
}

void MeasuredDistance::make() {
    const occupancy::DistanceSource source(bits_, {volume_.grid, voxel_m_}, code_,
                                           {config::DistanceContent::distance}, {}, {.threads = 1});
    values_ = source.distances();
}

occupancy::DistanceLookup MeasuredDistance::lookup() const {
    return [this, size = volume_.grid.size()](const std::array<double, 3>& place) {
        std::array<occupancy::AxisTaps, 3> taps;
        for (std::size_t a = 0; a < 3; ++a) {
            taps[a] = occupancy::filter_taps(config::OccupancyFilter::trilinear,
                                             place[a] / volume_.grid.cell, size[a], a < 2);
        }
        return code_.metres(occupancy::filtered_in_double(taps, [&](int x, int y, int z) {
            return values_[occupancy::index_of(size, x, y, z)];
        }));
    };
}

double MeasuredDistance::surface_share() const {
    const auto count = std::count_if(values_.begin(), values_.end(), [&](float value) {
        return code_.metres(double{value}) <= code_.rounding_m();
    });
    return static_cast<double>(count) / static_cast<double>(values_.size());
}

std::uint64_t MeasuredDistance::bytes() const {
    return values_.size() * static_cast<std::uint64_t>(bytes_per_value(bake_.pixel_type));
}

occupancy::DistanceCheckResult MeasuredDistance::check(int points) const {
    return check_distances({volume_.grid.size(), values_.data(), volume_.grid.cell}, code_,
                           occupancy::NearestVoxel(bits_, voxel_m_), volume_.grid.voxels, voxel_m_,
                           points, 0, {});
}

}  // namespace skybake
