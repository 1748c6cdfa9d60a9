#include "bakers/render/scene_view.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "bakers/light/sky_ray.h"
#include "bakers/math/parallel.h"
#include "bakers/math/transcendental.h"
#include "bakers/render/cloud_camera.h"

namespace skybake {
namespace {

constexpr int kNoises = 6;
constexpr double kWidestCell_m = 3000;
constexpr double kNarrowing = 2.75;   // from one noise to the next
constexpr double kAmplitude = 0.125;  // of each noise
constexpr double kGreatest = kNoises * kAmplitude;

// Returns a number in [-1, 1) for a corner of a noise's lattice.
double corner_value(std::int32_t x, std::int32_t y, int noise) {
    std::uint32_t bits = static_cast<std::uint32_t>(x) * 0x9e3779b1U ^
                         static_cast<std::uint32_t>(y) * 0x85ebca77U ^
                         static_cast<std::uint32_t>(noise) * 0xc2b2ae3dU;
    bits = (bits ^ bits >> 15) * 0x2c1b3c6dU;
    bits = (bits ^ bits >> 12) * 0x297a2d39U;
    bits ^= bits >> 15;
    return (bits >> 8) * 0x1p-23 - 1;
}

double smooth(double x) { return x * x * (3 - 2 * x); }

double value_noise(double x, double y, int noise) {
    const double low_x = std::floor(x);
    const double low_y = std::floor(y);
    const auto row = [&](int up) {
        const auto i = static_cast<std::int32_t>(low_x);
        const std::int32_t j = static_cast<std::int32_t>(low_y) + up;
        return std::lerp(corner_value(i, j, noise), corner_value(i + 1, j, noise),
                         smooth(x - low_x));
    };
    return std::lerp(row(0), row(1), smooth(y - low_y));
}

}  // namespace

double ground_mottle(double x_m, double y_m, double footprint_m) {
    double sum = 0;
    double cell_m = kWidestCell_m;
    for (int noise = 0; noise < kNoises; ++noise, cell_m /= kNarrowing) {
        // All of a noise is there whose cells are four footprints wide, nothing at one.
        const double share = smooth(std::clamp((cell_m / footprint_m - 1) / 3, 0.0, 1.0));
        if (share == 0) break;
        sum += share * kAmplitude * value_noise(x_m / cell_m, y_m / cell_m, noise);
        // The next lattice is turned, by angles that are no simple fractions of a turn.
        const double turned = 0.8 * x_m - 0.6 * y_m;
        y_m = 0.6 * x_m + 0.8 * y_m;
        x_m = turned;
    }
    return sum;
}

double ground_mottle_along(const glm::dvec3& eye_m, const glm::dvec3& direction, double pixel) {
    // Beyond this distance not even the widest cells are as wide as a pixel's footprint.
    const double distance_m = eye_m.z / -direction.z;
    if (!(direction.z < 0) || !(distance_m * pixel < kWidestCell_m)) return 0;
    const double footprint_m = std::max(distance_m * pixel / -direction.z, 1e-3);
    return ground_mottle(eye_m.x + distance_m * direction.x, eye_m.y + distance_m * direction.y,
                         footprint_m);
}

Spectrum mottled(const Spectrum& albedo, double mottle) {
    Spectrum share(1.0);
    for (std::size_t c = 0; c < 4; ++c) {
        const double room = albedo[c] > 0 ? (1 / albedo[c] - 1) / kGreatest : 1.0;
        share[c] += std::min(room, 1.0) * mottle;
    }
    return share;
}

namespace {

double middle_m(const SceneLayer& layer) {
    return layer.medium->base_m + 0.5 * layer.medium->extent_m[2];
}

using Bearing = SceneRenderer::Bearing;

Bearing bearing_of(const glm::dvec3& direction) {
    const double elevation =
        90 - arc_cosine(std::clamp(direction.z, -1.0, 1.0)) * kDegreesPerRadian;
    const double level = std::sqrt(direction.x * direction.x + direction.y * direction.y);
    const double turn =
        level > 0 ? arc_cosine(std::clamp(direction.x / level, -1.0, 1.0)) * kDegreesPerRadian : 0;
    return {elevation, direction.y < 0 ? -turn : turn};
}

// Returns the range of elevations that a picture shows.
CloudAir::Range range_of(const SceneFrame& frame, double reach_m) {
    const CameraRays rays(frame.camera, frame.width, frame.height);
    double lowest = 90;
    double highest = -90;
    for (int x = 0; x < frame.width; ++x) {
        for (int y = 0; y < frame.height; ++y) {
            if (x != 0 && x != frame.width / 2 && y != 0 && y != frame.height - 1) continue;
            const double elevation = bearing_of(rays.through(x, y)).elevation;
            lowest = std::min(lowest, elevation);
            highest = std::max(highest, elevation);
        }
    }
    CloudAir::Range range;
    range.degrees_per_pixel = frame.camera.horizontal_field_degrees / frame.width;
    range.lowest_degrees = std::max(lowest - range.degrees_per_pixel, -90.0);
    range.highest_degrees = std::min(highest + range.degrees_per_pixel, 90.0);
    range.reach_m = reach_m;
    return range;
}

// Returns the slope of rays from above all layers that touch the highest one's top on a round planet. Flat layers
// go on beyond it. There is none, and the slope is infinite, from below and for a tile that stands alone.
double limb_slope(const Shell& shell, const std::vector<SceneLayer>& layers,
                  const CloudCamera& camera) {
    constexpr double kNone = std::numeric_limits<double>::infinity();
    double top_m = 0;
    for (const SceneLayer& layer : layers) {
        if (!layer.medium->repeats) return kNone;
        top_m = std::max(top_m, layer.medium->base_m + layer.medium->extent_m[2]);
    }
    if (camera.position_m.z <= top_m) return kNone;
    const double cosine = (shell.ground_radius_km + top_m / 1000) /
                          (shell.ground_radius_km + camera.position_m.z / 1000);
    return -std::sqrt(1 - cosine * cosine);
}

// Calculates the radiance of a layer in a pixel from the results of its march.
Spectrum cloud_radiance(const CloudIllumination& light, const float* seen) {
    return light.sun_at_base * double{seen[0]} + light.sun_at_top * double{seen[1]} +
           light.sky * double{seen[2]} + light.ground * double{seen[3]};
}

}  // namespace

SceneRenderer::SceneRenderer(const std::vector<SceneLayer>& layers, const Atmosphere& atmosphere,
                             const SunDirection& sun, int threads)
    : layers_(layers), atmosphere_(atmosphere), sun_(sun) {
    std::ranges::stable_sort(layers_, [](const SceneLayer& a, const SceneLayer& b) {
        return middle_m(a) > middle_m(b);
    });
    const Spectrum dark{};
    bool sunlit = false;
    for (const SceneLayer& layer : layers_) {
        lights_.push_back(illumination(*layer.medium, atmosphere, sun, threads));
        const CloudIllumination& light = lights_.back();
        sunlit = sunlit || light.sun_at_base != dark || light.sun_at_top != dark;
        farthest_m_ = std::max(farthest_m_, layer.reach_m);
    }
    march_.emplace(layers_, sun, sunlit, true, threads);
    for (std::size_t l = 0; l < layers_.size(); ++l) {  // from the highest layer down
        lights_[l].sky *= through_;
        through_ *= march_->through(l);
        if (layers_[l].medium->repeats) ground_through_ *= march_->through(l);
    }
    for (CloudIllumination& light : lights_) light.ground *= through_;
    const GroundIrradiance ground = ground_irradiance(atmosphere, sun, threads);
    ground_sun_ = ground.sun;
    ground_sky_ = ground.sky;
}

const CloudAir& SceneRenderer::air_for(const SceneFrame& frame, int threads) {
    const CloudAir::Range range = range_of(frame, farthest_m_);
    const std::tuple key = {frame.camera.position_m[2], range.lowest_degrees, range.highest_degrees,
                            range.degrees_per_pixel};
    if (!air_ || air_key_ != key) {
        air_ = std::make_unique<const CloudAir>(atmosphere_, frame.camera, sun_, range, threads);
        air_key_ = key;
    }
    return *air_;
}

Spectrum SceneRenderer::ground_share(double direct) const {
    const double spread = std::max(ground_through_ - march_->direct(), 0.0);
    Spectrum share(1.0);
    for (int c = 0; c < atmosphere_.medium.air.channels; ++c) {
        const auto i = static_cast<std::size_t>(c);
        const double clear = ground_sun_[i] + ground_sky_[i];
        if (clear > 0) {
            share[i] =
                (ground_sun_[i] * (direct + spread) + ground_sky_[i] * ground_through_) / clear;
        }
    }
    return share;
}

Spectrum SceneRenderer::radiance(const CloudAir& air, const Bearing& bearing,
                                 const Spectrum& ground, const float* seen) const {
    const float* behind = seen + MarchedScene::kLayerChannels * layers_.size();
    Spectrum sum{};
    for (std::size_t l = 0; l < layers_.size(); ++l, seen += MarchedScene::kLayerChannels) {
        const double opacity = seen[4];
        if (!(opacity > 0)) continue;
        const CloudAir::Along along =
            air.along(bearing.elevation, bearing.azimuth, double{seen[5]} / opacity);
        sum +=
            along.transmittance * cloud_radiance(lights_[l], seen) + opacity * along.in_scattered;
    }
    const CloudAir::Along along = air.along(bearing.elevation, bearing.azimuth, 0);
    return sum + double{behind[0]} * (along.sky + (ground - Spectrum(1.0)) * along.ground);
}

CloudView SceneRenderer::render(const SceneFrame& frame, int threads, Progress* progress) {
    const MarchedScene marched = march_->march(frame, threads, progress);
    const CloudAir& air = air_for(frame, threads);
    const CameraRays rays(frame.camera, frame.width, frame.height);
    const int channels = atmosphere_.medium.air.channels;
    CloudView view;
    view.fetches = marched.fetches;
    view.refined_pixels = marched.refined_pixels;
    view.radiance = Image2<float>(frame.width, frame.height, channels);
    const double limb = limb_slope(shell_of(atmosphere_.medium.air), layers_, frame.camera);
    parallel_for(frame.height, threads, [&](int y) {
        for (int x = 0; x < frame.width; ++x) {
            const glm::dvec3 ray = rays.through(x, y);
            const float* seen = marched.results.texel(x, y);
            Spectrum ground =
                mottled(atmosphere_.medium.air.ground_albedo,
                        ground_mottle_along(frame.camera.position_m, ray, rays.pixel()));
            if (frame.ground && ray.z < 0) {
                ground *= ground_share(double{seen[marched.results.channels - 1]});
            }
            const Bearing bearing = bearing_of(ray);
            Spectrum light = radiance(air, bearing, ground, seen);
            // The share of the pixel over the limb shows the sky alone.
            const double over = std::clamp(0.5 + (ray.z - limb) / rays.pixel(), 0.0, 1.0);
            if (over > 0) {
                light = (1 - over) * light +
                        over * air.along(bearing.elevation, bearing.azimuth, 0).sky;
            }
            for (int c = 0; c < channels; ++c) {
                view.radiance.texel(x, y)[c] =
                    static_cast<float>(light[static_cast<std::size_t>(c)]);
            }
        }
    });
    return view;
}

}  // namespace skybake
