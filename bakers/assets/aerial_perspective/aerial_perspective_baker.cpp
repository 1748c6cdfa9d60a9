// The baker of asset = "aerial_perspective".
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bakers/assets/aerial_perspective/aerial_perspective_volume.h"
#include "bakers/assets/registry/baker.h"
#include "bakers/assets/sky/sky_asset.h"
#include "bakers/assets/sky/traced_light.h"
#include "bakers/light/shared_light.h"
#include "bakers/light/sky_light.h"
#include "bakers/light/sky_view_mapping.h"
#include "bakers/math/quadrature.h"
#include "config/assets/aerial_perspective.h"

namespace skybake {
namespace {

using config::AerialPerspectiveBake;

// Returns the orders that must be solved for.
config::SkyOrders solved_orders(const AerialPerspectiveBake& asset) {
    const bool has_light = asset.content != config::AerialContent::transmittance;
    return has_light ? asset.orders : config::SkyOrders::single;
}

std::vector<Need> needs(const Parameters& parameters, const AerialPerspectiveBake& asset,
                        Certification) {
    return light_needs(light_packets(parameters), solved_orders(asset), false);
}

Outcome<Baked> bake(const Parameters& parameters, const AerialPerspectiveBake& asset,
                    const BakeOptions& options, AssetLabel label) {
    const SkyLights lights(parameters, options, [&](const config::Atmosphere& atmosphere) {
        if (solved_orders(asset) == asset.orders) {
            return std::make_unique<SkyLight>(atmosphere, asset.orders, asset.layers, options);
        }
        // The transmittance that goes with light of these orders.
        return std::make_unique<SkyLight>(medium_of(LightRequest{.atmosphere = atmosphere}),
                                          config::SkyOrders::single, nullptr, options.threads);
    });
    return bake_of_light(lights, label.name, options, [&] {
        return bake_aerial_perspective(lights, asset, options,
                                       labelled_sky_volume(parameters, std::move(label)));
    });
}

Estimate estimate(const Parameters&, const AerialPerspectiveBake& asset) {
    Estimate result = estimate_volume(asset, asset.size, 4, 1e-5);
    result.seconds += seconds_to_solve(asset.orders);
    // All are held, and their parts (bruneton/scattering_table.h).
    constexpr double kBytesPerVoxel = (4 + 9) * sizeof(float);
    result.memory_mib += voxels_of(asset.size, 1) * kBytesPerVoxel / kMebibyte;
    return result;
}

AssetPlaces places(const Parameters& parameters, const AerialPerspectiveBake& asset,
                   const StoredTexels&) {
    const bool squared = asset.slices == config::SliceSpacing::squared;
    return single_lookup(
        {"picture_x", "picture_y", "distance_km"},
        [camera = AerialCamera(asset, shell_of(parameters.atmosphere)), squared](const Place& at) {
            const SlicedWay way = camera.way(at[0].second, at[1].second);
            const double share = std::max(at[2].second - way.begin_km, 0.0) / way.reach_km;
            return Uvw{at[0].second, at[1].second, squared ? std::sqrt(share) : share};
        });
}

// Returns the line of GLSL that finds the part of the view ray that slices divide.
std::string glsl_way(const AerialPerspectiveBake& asset, const AerialCamera& camera) {
    return fmt::format("    vec2 way = aerial_way(picture, vec2({}, {}), {}, {}, {}, {}, {});\n",
                       glsl_number(cosine_of(asset.pitch.radians)),
                       glsl_number(sine_of(asset.pitch.radians)), glsl_number(picture_reach(asset)),
                       glsl_number(asset.aspect), glsl_number(camera.radius_km()),
                       glsl_number(camera.air()->ground_radius_km),
                       glsl_number(camera.air()->ground_radius_km + camera.air()->thickness_km));
}

AssetLookup lookup(const Parameters& parameters, const AerialPerspectiveBake& asset,
                   const StoredTexels& stored) {
    const bool has_light = asset.content != config::AerialContent::transmittance;
    const bool has_both = asset.content == config::AerialContent::in_scatter_and_transmittance;
    const AerialCamera camera(asset, shell_of(parameters.atmosphere));
    const std::string view_distance = glsl_number(asset.view_distance.kilometers());
    const std::string distance =
        camera.air() ? fmt::format("distance_km - way.x, min(way.y, {})", view_distance)
                     : fmt::format("distance_km, {}", view_distance);
    const std::string arguments =
        fmt::format("air, {}, picture, {}, {}", glsl_number(stored.size[2]), distance,
                    asset.slices == config::SliceSpacing::squared);
    GlslFunction function;
    function.comment = fmt::format(
        "Returns {} over a distance of 0 to {} km along the view ray{}. `picture` is the place in "
        "the camera's picture, (0, 0) at its upper left.",
        has_both ? "the light that the air adds, in 1/sr for a solar irradiance of 1, and in the "
                   "last of four channels the transmittance,"
        : has_light ? "the light that the air adds, in 1/sr for a solar irradiance of 1,"
                    : "the transmittance",
        view_distance, camera.air() ? " within the air" : "");
    function.arguments = "sampler3D air, vec2 picture, float distance_km";
    if (camera.air()) function.before = glsl_way(asset, camera);
    const bool is_of_4 = stored.channels == 4 && !has_both;
    const std::string_view name = !has_light ? "aerial_transmittance"
                                  : is_of_4  ? "aerial_light"
                                             : "aerial_perspective";
    function.value = fmt::format("{}{}({})", name, is_of_4 ? "_of_4" : "", arguments);
    GlslFunction picture;
    picture.comment =
        "Returns the place of a view direction in the picture of the camera that has these axes of "
        "length 1. The direction must lie in front of it.";
    picture.result = "vec2";
    picture.arguments = "vec3 dir, vec3 forward, vec3 right, vec3 up";
    picture.value = fmt::format("aerial_picture(dir, forward, right, up, {}, {})",
                                glsl_number(picture_reach(asset)), glsl_number(asset.aspect));
    picture.suffix = "_picture";
    return {"aerial_perspective",
            {with_channels(stored.channels, has_light || is_of_4 ? 4 : 3, std::move(function)),
             std::move(picture)}};
}

// Points in the air all over the volume, down to the first slice's distance, and where they are in it.
struct Froxels {
    std::vector<Place> at;
    std::vector<AirSample> views;
};

// Points below the ground are left out: their voxels stand for points on the ground.
Froxels froxel_samples(const Shell& shell, const AerialPerspectiveBake& asset) {
    constexpr int kSamples = 96;
    const AerialCamera camera(asset, shell);
    const double first = 0.5 / asset.size[2];
    Froxels samples;
    for (int i = 0; i < kSamples; ++i) {
        const auto [u, v, w] = low_discrepancy_point(i);
        const ViewDirection view = camera.direction(u, v);
        const AirSample sample = {
            camera.altitude_km(), camera.sun(),
            sky_direction(camera.sun(), view.mu, view.sine, view.azimuth_cosine),
            camera.distance_km(u, v, first + (1 - first) * w)};
        const SkyRay ray = sky_ray(shell, sample.altitude_km, sample.sun, sample.direction);
        if (ray.meets_ground && sample.distance_km > ray.length_km) continue;
        samples.at.push_back(
            {{"picture_x", u}, {"picture_y", v}, {"distance_km", sample.distance_km}});
        samples.views.push_back(sample);
    }
    return samples;
}

std::optional<TracedLight> traced(const Parameters& parameters,
                                  const AerialPerspectiveBake& asset) {
    if (solved_orders(asset) == config::SkyOrders::single) return std::nullopt;
    const Froxels samples = froxel_samples(shell_of(parameters.atmosphere), asset);
    const auto trace_of = [&](std::shared_ptr<const TracedAir> air) {
        return trace_of_air(std::move(air), samples.views, asset.orders);
    };
    return TracedLight{light_channels(parameters), samples.at,
                       light_looked_up(places, parameters, asset, samples.at),
                       traces_of_packets(parameters, trace_of)};
}

void draft(AerialPerspectiveBake& asset, int) {
    for (int& edge : asset.size) edge = std::min(edge, 16);
    asset.mips = 1;
}

}  // namespace

Baker<config::AerialPerspectiveBake> baker(BakerTag<config::AerialPerspectiveBake>) {
    return {.version = 17,
            .bake = bake,
            .estimate = estimate,
            .needs = needs,
            .places = places,
            .lookup = lookup,
            .traced = traced,
            .draft = draft,
            .variants = {{"size"}, {"pixel_type"}, {"slices"}}};
}

}  // namespace skybake
