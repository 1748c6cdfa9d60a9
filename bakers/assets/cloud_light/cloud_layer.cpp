#include "bakers/assets/cloud_light/cloud_layer.h"

#include <algorithm>
#include <cmath>

#include "bakers/field/baked.h"
#include "bakers/field/voxel_array.h"
#include "bakers/math/transcendental.h"
#include "bakers/occupancy/cell_grid.h"
#include "config/assets/occupancy_filter.h"

namespace skybake::cloud_light {

using config::OccupancyFilter;

CloudLayer make_layer(const Baked& volume, std::size_t channel, const Cloud& cloud,
                      const BakeOptions& options) {
    const Level& level = volume.levels.front();
    CloudLayer layer;
    layer.size = level.size;
    for (std::size_t a = 0; a < 3; ++a) {
        layer.voxel_m[a] = cloud.extent[a].meters / level.size[a];
    }
    layer.optics = cloud_optics(cloud);
    layer.values.resize(occupancy::count_of(level.size));
    read_channel(volume, channel, options, layer.values.data());
    return layer;
}

double extinction_at(const CloudLayer& layer, const glm::dvec3& place) {
    if (place.z < 0 || place.z > layer.size[2]) return 0;
    std::array<occupancy::AxisTaps, 3> taps;
    for (std::size_t a = 0; a < 3; ++a) {
        taps[a] =
            occupancy::filter_taps(OccupancyFilter::trilinear, place[a], layer.size[a], a < 2);
    }
    const double value = occupancy::filtered_in_double(
        taps, [&](int x, int y, int z) { return layer.value(x, y, z); });
    return layer.optics.extinction_per_m * density(layer.optics, value);
}

glm::dvec3 towards(double elevation, double azimuth) {
    const SineCosine up = sine_and_cosine(elevation);
    const SineCosine around = sine_and_cosine(azimuth);
    return {up.cosine * around.cosine, up.cosine * around.sine, up.sine};
}

glm::dvec3 in_voxels(const CloudLayer& layer, const glm::dvec3& direction) {
    return {direction.x / layer.voxel_m[0], direction.y / layer.voxel_m[1],
            direction.z / layer.voxel_m[2]};
}

double ray_length(const CloudLayer& layer, const glm::dvec3& place, const glm::dvec3& along) {
    return std::min({(layer.size[2] - place.z) / along.z, layer.reach[0] / std::abs(along.x),
                     layer.reach[1] / std::abs(along.y)});
}

}  // namespace skybake::cloud_light
