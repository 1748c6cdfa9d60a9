#include "bakers/render/scene_view.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "bakers/light/sky_ray.h"
#include "bakers/math/parallel.h"
#include "bakers/math/transcendental.h"
#include "bakers/render/cloud_camera.h"
#include "bakers/render/ground_albedo.h"

namespace skybake {

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

// Calculates the radiance of a layer in a pixel from the results of its march.
Spectrum cloud_radiance(const CloudIllumination& light, const float* seen) {
    return light.sun_at_base * double{seen[0]} + light.sun_at_top * double{seen[1]} +
           light.sky * double{seen[2]} + light.ground * double{seen[3]};
}

}  // namespace

SceneRenderer::SceneRenderer(const std::vector<SceneLayer>& layers, const Atmosphere& atmosphere,
                             const SunDirection& sun, int threads, bool leaping)
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
    march_.emplace(layers_, sun, sunlit, leaping, threads);
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
            const Spectrum light = radiance(air, bearing_of(ray), ground, seen);
            for (int c = 0; c < channels; ++c) {
                view.radiance.texel(x, y)[c] =
                    static_cast<float>(light[static_cast<std::size_t>(c)]);
            }
        }
    });
    return view;
}

}  // namespace skybake
