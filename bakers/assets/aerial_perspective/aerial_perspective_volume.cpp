#include "bakers/assets/aerial_perspective/aerial_perspective_volume.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <chrono>
#include <cstddef>
#include <memory>
#include <utility>

#include "bakers/assets/sky_asset.h"
#include "bakers/field/finish_volume.h"
#include "bakers/light/sky_ray.h"
#include "bakers/math/parallel.h"
#include "config/assets/aerial_perspective.h"

namespace skybake {

using config::AerialContent;
using config::AerialPerspectiveBake;

namespace {

// The channels of a voxel.
std::vector<double> channels_of(const SkyLight& light, const SkyRadiance& radiance,
                                AerialContent content) {
    const auto colours = light.medium().air.channels;
    const Spectrum in_scatter = light.wanted(radiance);
    std::vector<double> values;
    if (content == AerialContent::transmittance) {
        values.assign(data(radiance.transmittance), data(radiance.transmittance) + colours);
        return values;
    }
    values.assign(data(in_scatter), data(in_scatter) + colours);
    if (content == AerialContent::in_scatter_and_transmittance) {
        double sum = 0;
        for (int c = 0; c < colours; ++c) {
            sum += radiance.transmittance[static_cast<std::size_t>(c)];
        }
        values.push_back(sum / colours);
    }
    return values;
}

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
    const std::vector<SkyRadiance> values = light.integrator().up_to(ray.in_air, in_air);
    result.insert(result.end(), values.begin(), values.end());
}

// All voxels, made when constructed: those of a ray share the way to them.
class FroxelSource : public VoxelSource {
  public:
    FroxelSource(const SkyLight& light, const AerialCamera& camera,
                 const AerialPerspectiveBake& bake, std::size_t channels,
                 const BakeOptions& options)
        : size_(bake.size), values_(channels) {
        std::vector<double> distances;
        for (int k = 0; k < size_[2]; ++k) {
            distances.push_back(camera.distance_km((k + 0.5) / size_[2]));
        }
        for (std::vector<float>& channel : values_) {
            channel.resize(static_cast<std::size_t>(VoxelBox{{}, size_}.count()));
        }
        for_each_tile(size_[1], options, "froxels", [&](int y) {
            for (int x = 0; x < size_[0]; ++x) {
                const std::vector<SkyRadiance> ray = aerial_perspective(
                    light, camera, (x + 0.5) / size_[0], (y + 0.5) / size_[1], distances);
                for (int z = 0; z < size_[2]; ++z) {
                    const std::vector<double> voxel =
                        channels_of(light, ray[static_cast<std::size_t>(z)], bake.content);
                    for (std::size_t c = 0; c < channels; ++c) {
                        values_[c][offset(x, y, z)] = static_cast<float>(voxel[c]);
                    }
                }
            }
        });
    }

    void fill(const VoxelBox& box, const std::vector<float*>& channels) const override {
        for (std::size_t c = 0; c < channels.size(); ++c) {
            float* target = channels[c];
            if (target == nullptr) continue;
            for (int z = box.origin[2]; z < box.origin[2] + box.size[2]; ++z) {
                for (int y = box.origin[1]; y < box.origin[1] + box.size[1]; ++y) {
                    target = std::copy_n(values_[c].data() + offset(box.origin[0], y, z),
                                         box.size[0], target);
                }
            }
        }
    }

    double largest(std::size_t channel) const {
        return *std::max_element(values_[channel].begin(), values_[channel].end());
    }

  private:
    std::size_t offset(int x, int y, int z) const {
        const auto width = static_cast<std::size_t>(size_[0]);
        const auto height = static_cast<std::size_t>(size_[1]);
        return (static_cast<std::size_t>(z) * height + static_cast<std::size_t>(y)) * width +
               static_cast<std::size_t>(x);
    }

    std::array<int, 3> size_;
    std::vector<std::vector<float>> values_;  // per channel, [z][y][x]
};

std::string content_text(const AerialPerspectiveBake& bake) {
    const std::string light = fmt::format(
        "light that the air adds between the camera and a point (1/sr) for a solar irradiance of "
        "1: {}",
        light_text(bake.orders, bake.layers));
    const std::string passing = "transmittance from the point to the camera (dimensionless)";
    if (bake.content == AerialContent::in_scatter) return light;
    if (bake.content == AerialContent::transmittance) return passing;
    return fmt::format("R, G, B: {}; A: {}, mean of R, G, B", light, passing);
}

// The camera in the digits that people write. Distance is view_distance_km times w to the
// `exponent`.
void describe_axes(const AerialPerspectiveBake& bake, std::size_t colours, Baked& volume) {
    const double heading = to_digits(bake.heading.radians * kDegreesPerRadian, 9);
    const double pitch = to_digits(bake.pitch.radians * kDegreesPerRadian, 9);
    const double fov = to_digits(bake.fov.radians * kDegreesPerRadian, 9);
    const bool squared = bake.slices == config::SliceSpacing::squared;
    volume.axes[0].constants = {
        {"heading_deg", heading}, {"fov_deg", fov}, {"aspect", bake.aspect}};
    volume.axes[1].constants = {{"pitch_deg", pitch}, {"fov_deg", fov}};
    volume.axes[2].constants = {{"view_distance_km", bake.view_distance.kilometers()},
                                {"exponent", squared ? 2.0 : 1.0}};
    for (AxisMapping& axis : volume.axes) axis.end_points = TexelConvention::end_points_on_edges;
    volume.conventions.angle_unit = "deg";
    volume.conventions.up_axis = volume.up_axis;
    if (bake.content == AerialContent::transmittance) return;
    volume.conventions.radiance_unit = "1/sr";
    volume.conventions.solar_irradiance.assign(colours, 1);
}

void describe(const AerialPerspectiveBake& bake, const std::vector<std::string>& colour_names,
              Baked& volume) {
    const std::string convention = "clamps; voxel i samples (i + 1/2) / size";
    const bool squared = bake.slices == config::SliceSpacing::squared;
    volume.kind = "aerial_perspective";
    volume.content = content_text(bake);
    volume.mapping = "froxels";
    volume.axes = {
        {{"picture_x", "u from the left edge; X = 2 u - 1", convention, 0, 1},
         {"picture_y", "v from the upper edge; Y = 1 - 2 v", convention, 0, 1},
         {"distance_km",
          fmt::format("w = {} of the distance along the view ray over {:.9g} km",
                      squared ? "square root" : "share", bake.view_distance.kilometers()),
          convention, 0, bake.view_distance.kilometers()}}};
    volume.channel_names = colour_names;
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
    describe_axes(bake, colour_names.size(), volume);
}

}  // namespace

std::vector<SkyRadiance> aerial_perspective(const SkyLight& light, const AerialCamera& camera,
                                            double u, double v,
                                            const std::vector<double>& distances_km) {
    assert(std::is_sorted(distances_km.begin(), distances_km.end()));
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

config::Outcome<Baked> bake_aerial_perspective(const SkyLight& light,
                                               const AerialPerspectiveBake& bake,
                                               const BakeOptions& options,
                                               const std::vector<std::string>& colour_names,
                                               Baked volume) {
    describe(bake, colour_names, volume);
    const AerialCamera camera(bake);
    const auto start = std::chrono::steady_clock::now();
    const auto froxels = std::make_shared<const FroxelSource>(light, camera, bake,
                                                              volume.channel_names.size(), options);
    volume.bake_seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    VolumeFinish finish;
    for (std::size_t c = 0; c < volume.channel_names.size(); ++c) {
        const double largest = froxels->largest(c);
        finish.histogram_ranges.push_back({0, largest > 0 ? largest : 1});
    }
    finish.reference = [&light, &camera, &bake](const std::array<double, 3>& uvw) {
        const auto at =
            aerial_perspective(light, camera, uvw[0], uvw[1], {camera.distance_km(uvw[2])});
        return channels_of(light, at.front(), bake.content);
    };
    finish.reference_name = "quadrature along each view ray, exact sunlight and transmittance";
    finish.probe_place = [&camera, slices = bake.size[2]](std::array<double, 3> uvw, int) {
        // Nearer than the first slice a runtime scales what it finds there.
        uvw[2] = std::max(uvw[2], 0.5 / slices);
        return ProbePlace{{{"picture_x", uvw[0]},
                           {"picture_y", uvw[1]},
                           {"distance_km", camera.distance_km(uvw[2])}},
                          {{uvw}}};
    };
    Level level;
    level.size = bake.size;
    level.repeats = repeating_axes(volume.axes);
    level.voxels = froxels;
    volume.levels.push_back(std::move(level));
    add_mip_levels(bake.mips, options, volume);
    return finish_volume(std::move(volume), finish, options);
}

}  // namespace skybake
