// The baker of asset = "environment".
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <numbers>
#include <utility>

#include "bakers/assets/baker.h"
#include "bakers/assets/environment/environment_table.h"
#include "bakers/assets/sky_asset.h"
#include "bakers/light/sky_light.h"
#include "config/assets/environment.h"

namespace skybake {

using config::EnvironmentBake;
using config::Outcome;
using config::Parameters;

namespace {

Outcome<Baked> bake(const Parameters& parameters, const EnvironmentBake& asset,
                    const BakeOptions& options, AssetLabel label) {
    const SkyLight light(parameters.atmosphere, asset.orders, asset.layers, options);
    return bake_of_light(light, label.name, options, [&](const SkyLight& found) {
        return bake_environment(found, asset, options,
                                labelled_table(parameters, std::move(label)));
    });
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
    function.value = "environment(table, dir, up, sun)";
    return {"environment", {with_channels(stored.channels, 3, std::move(function))}};
}

void draft(EnvironmentBake& asset, int) {
    asset.size = {std::min(asset.size[0], 128), std::min(asset.size[1], 64)};
}

}  // namespace

const Baker<EnvironmentBake>& baker(BakerTag<EnvironmentBake>) {
    static const Baker<EnvironmentBake> row = {.version = 2,
                                               .bake = bake,
                                               .estimate = estimate,
                                               .places = places,
                                               .lookup = lookup,
                                               .draft = draft};
    return row;
}

}  // namespace skybake
