// The baker of asset = "environment".
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <memory>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include "bakers/assets/baker.h"
#include "bakers/assets/environment/environment_table.h"
#include "bakers/assets/sky_asset.h"
#include "bakers/light/sky_light.h"
#include "bakers/light/sky_view_mapping.h"
#include "config/assets/environment.h"

namespace skybake {

using config::EnvironmentBake;
using config::Outcome;
using config::Parameters;

namespace {

Outcome<Baked> bake(const Parameters& parameters, const EnvironmentBake& asset,
                    const BakeOptions& options, AssetLabel label) {
    const SkyLights lights(parameters, options, [&](const config::Atmosphere& atmosphere) {
        return std::make_unique<SkyLight>(atmosphere, asset.orders, asset.layers, options);
    });
    return bake_of_light(lights, label.name, options, [&](const SkyLights& found) {
        return bake_environment(found, asset, options,
                                labelled_light_table(parameters, std::move(label)));
    });
}

std::vector<Need> needs(const Parameters& parameters, const EnvironmentBake& asset, Certification) {
    return light_needs(parameters, asset.orders, true);
}

Estimate estimate(const Parameters&, const EnvironmentBake& asset) {
    return estimate_texels(asset, asset.size, 3e-6, 0.3 + seconds_to_solve(asset.orders));
}

AssetPlaces places(const Parameters&, const EnvironmentBake&, const StoredTexels&) {
    return single_lookup({"azimuth_deg", "elevation_deg"}, [](const Place& at) {
        return Uvw{at[0].second / 360 + 0.5, 0.5 - at[1].second / 180, 0.5};
    });
}

AssetLookup lookup(const Parameters&, const EnvironmentBake& asset, const StoredTexels& stored) {
    GlslFunction function;
    function.comment = fmt::format(
        "Returns the radiance of the sky or of the ground in 1/sr, for a solar irradiance of 1, "
        "seen from an altitude of {} km. The unit vectors point along the view ray, away from the "
        "planet's centre and to the sun, which is at an elevation of {} degrees.",
        glsl_number(asset.altitude.kilometers()),
        to_digits(asset.sun_elevation.radians * 180 / std::numbers::pi, 9));
    function.arguments = "sampler2D table, vec3 dir, vec3 up, vec3 sun";
    function.value = fmt::format("environment{}(table, dir, up, sun)", of_4(stored.channels));
    return {"environment", {with_wavelengths(stored.channels, std::move(function))}};
}

std::optional<TracedLight> traced(const Parameters& parameters, const EnvironmentBake& asset) {
    if (asset.orders == config::SkyOrders::single) return std::nullopt;
    const Shell shell = shell_of(parameters.atmosphere);
    const double altitude_km = asset.altitude.kilometers();
    const double dip_deg = SkyViewCamera(shell, altitude_km).dip() * kDegreesPerRadian;
    const std::vector<SkySample> samples =
        sky_samples(shell, altitude_km, asset.sun_elevation.radians * kDegreesPerRadian);
    std::vector<Place> at;
    for (const SkySample& sample : samples) {
        // Every other view is to the left of the sun.
        const double side = at.size() % 2 == 0 ? 1 : -1;
        at.push_back({{"azimuth_deg", side * sample.azimuth_deg},
                      {"elevation_deg", sample.above_horizon_deg - dip_deg}});
    }
    const auto places_in = [&](const StoredTexels& stored) {
        return places(parameters, asset, stored);
    };
    const auto trace_of = [&](std::shared_ptr<const TracedAir> air) {
        return trace_of_sky(std::move(air), samples, asset.orders, true);
    };
    return TracedLight{light_channels(parameters), places_of(samples),
                       light_looked_up(places_in, std::move(at)),
                       traces_of_packets(parameters, trace_of)};
}

void draft(EnvironmentBake& asset, int) {
    asset.size = {std::min(asset.size[0], 128), std::min(asset.size[1], 64)};
}

}  // namespace

const Baker<EnvironmentBake>& baker(BakerTag<EnvironmentBake>) {
    static const Baker<EnvironmentBake> row = {.version = 8,
                                               .bake = bake,
                                               .estimate = estimate,
                                               .needs = needs,
                                               .places = places,
                                               .lookup = lookup,
                                               .traced = traced,
                                               .draft = draft};
    return row;
}

}  // namespace skybake
