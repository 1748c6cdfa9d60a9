#include "tests/support/cloud_view_reference.h"

#include <algorithm>

#include "bakers/occupancy/cell_grid.h"
#include "bakers/render/cloud_camera.h"
#include "config/assets/occupancy_filter.h"
#include "tests/support/light_in_cloud_reference.h"

namespace skybake {
namespace {

using VoxelPlace = std::array<double, 3>;  // voxels

double lookup(const PaddedVolume& volume, const VoxelPlace& at) {
    std::array<occupancy::AxisTaps, 3> taps;
    for (std::size_t a = 0; a < 3; ++a) {
        taps[a] = occupancy::filter_taps(config::OccupancyFilter::trilinear, at[a], volume.size[a],
                                         a < 2);
    }
    return occupancy::filtered_in_double(taps, [&](int x, int y, int z) {
        return volume.values[static_cast<std::size_t>((z + 1) * volume.plane() +
                                                      (y + 1) * volume.row() + x + 1)];
    });
}

double extinction(const CloudMedium& medium, const VoxelPlace& at) {
    if (at[2] < 0 || at[2] > medium.volume.size[2]) return 0;
    return medium.optics.extinction_per_m * density(medium.optics, lookup(medium.volume, at));
}

double share(const CloudMedium& medium, const PaddedVolume& shares, const VoxelPlace& at) {
    VoxelPlace scaled;
    for (std::size_t a = 0; a < 3; ++a) {
        scaled[a] = at[a] * shares.size[a] / medium.volume.size[a];
    }
    return lookup(shares, scaled);
}

VoxelPlace moved(const CloudMedium& medium, const VoxelPlace& from, const glm::dvec3& direction,
                 double t) {
    VoxelPlace to;
    for (std::size_t a = 0; a < 3; ++a) {
        to[a] = from[a] + t * direction[a] / medium.meters_per_voxel(a);
    }
    return to;
}

double depth_towards_sun(const CloudMedium& medium, const VoxelPlace& from, const glm::dvec3& sun,
                         double length_m, int steps) {
    // Up or down to the layer's face, if that is nearer.
    const double z = from[2] * medium.meters_per_voxel(2);
    const double to_face = sun[2] > 0 ? (medium.extent_m[2] - z) / sun[2] : -z / sun[2];
    const double length = sun[2] == 0 ? length_m : std::min(length_m, to_face);
    double sum = 0;
    for (int i = 0; i < steps; ++i) {
        sum += extinction(medium, moved(medium, from, sun, (i + 0.5) / steps * length));
    }
    return sum * length / steps;
}

}  // namespace

ReferenceRay reference_ray(const CloudMedium& medium, const DiffuseShare& diffuse,
                           const MarchSettings& settings, const glm::dvec3& direction, int steps) {
    const RaySpan span =
        span_in_layer(medium, settings.camera.position_m, direction, settings.reach_m);
    ReferenceRay result;
    if (!(span.first_m < span.last_m)) return result;
    const auto octaves = octave_phases();
    const glm::dvec3 sun =
        direction_of(settings.sun.elevation_degrees, settings.sun.azimuth_degrees);
    const double offset = one_minus_cosine(direction, sun);
    VoxelPlace origin;
    for (std::size_t a = 0; a < 3; ++a) {
        origin[a] = (settings.camera.position_m[a] - (a == 2 ? medium.base_m : 0)) /
                    medium.meters_per_voxel(a);
    }
    const double step = (span.last_m - span.first_m) / steps;
    for (int i = 0; i < steps; ++i) {
        const double t = span.first_m + (i + 0.5) * step;
        const VoxelPlace at = moved(medium, origin, direction, t);
        const double sigma = extinction(medium, at);
        if (sigma == 0) continue;
        const double met = settings.solved != nullptr ? settings.solved->share * sigma : sigma;
        const double through = exponential(-met * step);
        const double weight = result.transmittance * (1 - through);
        const double tau =
            depth_towards_sun(medium, at, sun, sun_march_length_m(medium, settings.sun), steps);
        double sunlight = sun_scattering(octaves, offset, tau);
        double from_sky = 0.5 * share(medium, diffuse.from_sky, at);
        double from_ground = 0.5 * share(medium, diffuse.from_ground, at);
        const double height = at[2] / medium.volume.size[2];
        if (settings.solved != nullptr) {
            const glm::dvec3 place(at[0] / medium.volume.size[0], at[1] / medium.volume.size[1],
                                   height);
            const ReferenceLight light = reference_light(*settings.solved, direction, offset,
                                                         place - glm::floor(place), {tau, 0});
            sunlight = light.sun;
            from_sky = light.sky;
            from_ground = light.ground;
        }
        result.sun_at_base += weight * sunlight * (1 - height);
        result.sun_at_top += weight * sunlight * height;
        result.from_sky += weight * from_sky;
        result.from_ground += weight * from_ground;
        result.distance_m += weight * t;
        result.transmittance *= through;
    }
    return result;
}

}  // namespace skybake
