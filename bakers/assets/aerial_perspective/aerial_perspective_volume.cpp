#include "bakers/assets/aerial_perspective/aerial_perspective_volume.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cstddef>
#include <memory>
#include <numeric>
#include <span>
#include <utility>

#include "bakers/field/baked.h"
#include "bakers/field/finish_volume.h"
#include "bakers/field/voxel_array.h"
#include "bakers/light/sky_ray.h"
#include "bakers/math/parallel.h"

namespace skybake {

using config::AerialContent;
using config::AerialPerspectiveBake;

namespace {

// Makes the channels of voxels from the light of all wavelengths.
class FroxelChannels {
  public:
    FroxelChannels(const SkyLights& lights, const AerialCamera& camera, AerialContent content)
        : lights_(lights), camera_(camera), content_(content), white_(colours()) {
        lights.write_channels(
            1,
            [](const SkyLight& light, double* values) {
                std::fill_n(values, light.medium().air.channels, 1.0);
            },
            white_.data());
    }

    std::size_t count() const {
        return colours() + (content_ == AerialContent::in_scatter_and_transmittance ? 1 : 0);
    }

    // Returns the channels of the voxels along the ray at (u, v), voxel after voxel.
    std::vector<double> along(double u, double v, const std::vector<double>& w) const {
        std::vector<double> distances_km;
        for (const double one : w) distances_km.push_back(camera_.distance_km(u, v, one));
        const std::size_t colours = this->colours();
        // In turns, the light that the air adds and the transmittance.
        std::vector<double> pairs(2 * distances_km.size() * colours);
        lights_.write_channels(
            2 * distances_km.size(),
            [&](const SkyLight& light, double* to) {
                const int channels = light.medium().air.channels;
                for (const SkyRadiance& at :
                     aerial_perspective(light, camera_, u, v, distances_km)) {
                    const Spectrum in_scatter = light.wanted(at);
                    to = std::copy_n(data(in_scatter), channels, to);
                    to = std::copy_n(data(at.transmittance), channels, to);
                }
            },
            pairs.data());
        std::vector<double> values;
        for (auto light = pairs.begin(); light != pairs.end();
             light += static_cast<std::ptrdiff_t>(2 * colours)) {
            append_voxel({light, light + static_cast<std::ptrdiff_t>(2 * colours)}, values);
        }
        return values;
    }

  private:
    std::size_t colours() const { return static_cast<std::size_t>(lights_.channels()); }

    void append_voxel(std::span<double> pair, std::vector<double>& values) const {
        const std::span<double> in_scatter = pair.first(white_.size());
        const std::span<double> transmittance = pair.last(white_.size());
        // Transmittance is that of light with the sun's spectrum, which need not be (1, 1, 1).
        for (std::size_t c = 0; c < white_.size(); ++c) transmittance[c] /= white_[c];
        if (content_ == AerialContent::transmittance) {
            values.insert(values.end(), transmittance.begin(), transmittance.end());
            return;
        }
        values.insert(values.end(), in_scatter.begin(), in_scatter.end());
        if (content_ == AerialContent::in_scatter_and_transmittance) {
            const double sum = std::accumulate(transmittance.begin(), transmittance.end(), 0.0);
            values.push_back(sum / static_cast<double>(white_.size()));
        }
    }

    const SkyLights& lights_;
    const AerialCamera& camera_;
    AerialContent content_;
    std::vector<double> white_;  // light of 1 at all wavelengths
};

CameraRay ray_towards(const Shell& shell, const AerialCamera& camera,
                      const ViewDirection& direction) {
    const SkyDirection towards =
        sky_direction(camera.sun(), direction.mu, direction.sine, direction.azimuth_cosine);
    return camera_ray(shell, camera.altitude_km(), camera.sun(), towards);
}

bool is_below_ground(const CameraRay& ray, double distance_km) {
    return ray.in_air.meets_ground && distance_km > ray.distance_km + ray.in_air.length_km;
}

// The direction of the same azimuth whose ray meets the ground after this distance, at most
// that to the horizon: R^2 = r^2 + 2 s d + d^2 with s = r mu, and rho^2 = r^2 - R^2.
ViewDirection lifted(const AerialCamera& camera, const Shell& shell, const ViewDirection& direction,
                     double distance_km) {
    const double rho = horizon_distance_km(shell, camera.altitude_km());
    const double r = shell.ground_radius_km + camera.altitude_km();
    // A camera on the ground looks along it.
    const double s = distance_km > 0 ? -0.5 * (rho * (rho / distance_km) + distance_km) : 0;
    const double mu = std::max(s / r, -1.0);  // straight down, but for rounding
    return {mu, std::sqrt((1 - mu) * (1 + mu)), direction.azimuth_cosine};
}

// Light and transmittance up to the distances from the camera.
void append_along(const SkyLight& light, const CameraRay& ray,
                  const std::vector<double>& distances_km, std::vector<SkyRadiance>& result) {
    std::vector<double> in_air;
    for (const double distance : distances_km) {
        in_air.push_back(std::clamp(distance - ray.distance_km, 0.0, ray.in_air.length_km));
    }
    const std::vector<SkyRadiance> values = with_once(
        light, [&](const SkyLight& any) { return any.integrator().up_to(ray.in_air, in_air); });
    result.insert(result.end(), values.begin(), values.end());
}

// Makes all voxels. Those of a ray share the way to them.
VoxelArray make_froxels(const FroxelChannels& channels, const std::array<int, 3>& size,
                        const BakeOptions& options) {
    VoxelArray froxels(size, channels.count());
    std::vector<double> w;
    for (int k = 0; k < size[2]; ++k) w.push_back((k + 0.5) / size[2]);
    for_each_tile(size[1], options, "froxels", [&](int y) {
        for (int x = 0; x < size[0]; ++x) {
            const std::vector<double> ray =
                channels.along((x + 0.5) / size[0], (y + 0.5) / size[1], w);
            const double* value = ray.data();
            for (int z = 0; z < size[2]; ++z) {
                for (std::size_t c = 0; c < froxels.channels(); ++c) {
                    froxels.channel(c)[froxels.offset(x, y, z)] = static_cast<float>(*value++);
                }
            }
        }
    });
    return froxels;
}

std::string content_text(const AerialPerspectiveBake& bake, bool is_colored) {
    const std::string light = fmt::format(
        "light that the air adds between the camera and a point (1/sr) for a solar irradiance of "
        "1: {}",
        light_text(bake.orders, bake.layers));
    const std::string passing =
        fmt::format("transmittance from the point to the camera{} (dimensionless)",
                    is_colored ? " for light with the sun's spectrum" : "");
    if (bake.content == AerialContent::in_scatter) return light;
    if (bake.content == AerialContent::transmittance) return passing;
    return fmt::format("R, G, B: {}; A: {}, mean of R, G, B", light, passing);
}

// The camera in the digits that people write. Distance is view_distance_km times w to the
// `exponent`; with the radii it is the part of the ray in the air that mapping.h tells.
void describe_axes(const AerialPerspectiveBake& bake, const AerialCamera& camera,
                   std::size_t colours, Baked& volume) {
    const double heading = to_digits(bake.heading.radians * kDegreesPerRadian, 9);
    const double pitch = to_digits(bake.pitch.radians * kDegreesPerRadian, 9);
    const double fov = to_digits(bake.fov.radians * kDegreesPerRadian, 9);
    const bool squared = bake.slices == config::SliceSpacing::squared;
    volume.axes[0].constants = {
        {"heading_deg", heading}, {"fov_deg", fov}, {"aspect", bake.aspect}};
    volume.axes[1].constants = {{"pitch_deg", pitch}, {"fov_deg", fov}};
    volume.axes[2].constants = {{"view_distance_km", bake.view_distance.kilometers()},
                                {"exponent", squared ? 2.0 : 1.0}};
    if (camera.air()) {
        const Facts radii = {
            {"camera_radius_km", to_digits(camera.radius_km(), 9)},
            {"ground_radius_km", to_digits(camera.air()->ground_radius_km, 9)},
            {"top_radius_km",
             to_digits(camera.air()->ground_radius_km + camera.air()->thickness_km, 9)}};
        volume.axes[2].constants.insert(volume.axes[2].constants.end(), radii.begin(), radii.end());
    }
    for (AxisMapping& axis : volume.axes) axis.end_points = TexelConvention::end_points_on_edges;
    volume.conventions.angle_unit = "deg";
    volume.conventions.up_axis = volume.up_axis;
    if (bake.content == AerialContent::transmittance) return;
    volume.conventions.radiance_unit = "1/sr";
    volume.conventions.solar_irradiance.assign(colours, 1);
}

void describe(const AerialPerspectiveBake& bake, const AerialCamera& camera,
              const SkyLights& lights, Baked& volume) {
    const std::string convention = "clamps; voxel i samples (i + 1/2) / size";
    const bool squared = bake.slices == config::SliceSpacing::squared;
    volume.kind = "aerial_perspective";
    volume.content = content_text(bake, lights.makes_colors());
    volume.mapping = "froxels";
    volume.axes = {
        {{"picture_x", "u from the left edge; X = 2 u - 1", convention, 0, 1},
         {"picture_y", "v from the upper edge; Y = 1 - 2 v", convention, 0, 1},
         {"distance_km",
          fmt::format("w = {} of the distance along the view ray{} over {}{:.9g} km",
                      squared ? "square root" : "share",
                      camera.air() ? ", from where it enters the air," : "",
                      camera.air()
                          ? "twice its way to the ground, or its way through the air, but at most "
                          : "",
                      bake.view_distance.kilometers()),
          convention, 0, bake.view_distance.kilometers()}}};
    const auto colours = static_cast<std::size_t>(lights.channels());
    volume.channel_names = names_of_channels(colours);
    if (bake.content == AerialContent::in_scatter_and_transmittance) {
        volume.channel_names.emplace_back("A");
    }
    set_files(bake, volume);
    volume.voxel_size_m.fill(1.0 / bake.size[0]);  // texture space, a metre wide
    volume.up_axis = "-y";
    const auto add = [&](const char* name, double value) {
        volume.details.emplace_back(name, to_digits(value, 9));
    };
    add("camera_altitude_km", bake.altitude.kilometers());
    add("sun_elevation_deg", bake.sun_elevation.radians * kDegreesPerRadian);
    add("heading_deg", bake.heading.radians * kDegreesPerRadian);
    add("pitch_deg", bake.pitch.radians * kDegreesPerRadian);
    add("fov_deg", bake.fov.radians * kDegreesPerRadian);
    add("aspect", bake.aspect);
    describe_axes(bake, camera, colours, volume);
}

}  // namespace

std::vector<SkyRadiance> aerial_perspective(const SkyLight& light, const AerialCamera& camera,
                                            double u, double v,
                                            const std::vector<double>& distances_km) {
    assert(std::ranges::is_sorted(distances_km));
    const ViewDirection direction = camera.direction(u, v);
    const CameraRay ray = ray_towards(light.shell(), camera, direction);
    const double horizon_km = horizon_distance_km(light.shell(), camera.altitude_km());
    std::vector<SkyRadiance> result;
    std::vector<double> together;
    for (const double distance : distances_km) {
        if (is_below_ground(ray, distance)) break;
        together.push_back(distance);
    }
    append_along(light, ray, together, result);
    while (result.size() < distances_km.size() && distances_km[result.size()] < horizon_km) {
        const double distance = distances_km[result.size()];
        append_along(
            light,
            ray_towards(light.shell(), camera, lifted(camera, light.shell(), direction, distance)),
            {distance}, result);
    }
    together.assign(distances_km.begin() + static_cast<std::ptrdiff_t>(result.size()),
                    distances_km.end());
    if (!together.empty()) {
        append_along(light,
                     ray_towards(light.shell(), camera,
                                 lifted(camera, light.shell(), direction, horizon_km)),
                     together, result);
    }
    return result;
}

Outcome<Baked> bake_aerial_perspective(const SkyLights& lights, const AerialPerspectiveBake& bake,
                                       const BakeOptions& options, Baked volume) {
    const AerialCamera camera(bake, lights.first().shell());
    describe(bake, camera, lights, volume);
    const FroxelChannels channels(lights, camera, bake.content);
    const auto froxels =
        std::make_shared<const VoxelArray>(make_froxels(channels, bake.size, options));
    VolumeFinish finish;
    finish.histogram_ranges = froxels->ranges();
    finish.reference = [&channels](const std::array<double, 3>& uvw) {
        return channels.along(uvw[0], uvw[1], {uvw[2]});
    };
    finish.reference_name = "quadrature along each view ray, exact sunlight and transmittance";
    finish.probe_place = [&camera, slices = bake.size[2]](std::array<double, 3> uvw, int) {
        // Nearer than the first slice a runtime scales what it finds there.
        uvw[2] = std::max(uvw[2], 0.5 / slices);
        return ProbePlace{{{"picture_x", uvw[0]},
                           {"picture_y", uvw[1]},
                           {"distance_km", camera.distance_km(uvw[0], uvw[1], uvw[2])}},
                          {{uvw}}};
    };
    add_voxels(bake.size, froxels, volume);
    add_mip_levels(bake.mips, options, volume);
    return finish_volume(std::move(volume), finish, options);
}

}  // namespace skybake
