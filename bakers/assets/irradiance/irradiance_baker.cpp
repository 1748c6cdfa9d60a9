// The baker of asset = "irradiance".
#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bakers/assets/irradiance/irradiance_table.h"
#include "bakers/assets/registry/baker.h"
#include "bakers/assets/sky/sky_asset.h"
#include "bakers/assets/sky/traced_light.h"
#include "bakers/field/image.h"
#include "bakers/light/multiple_scattering_mapping.h"
#include "bakers/light/sky_light.h"
#include "config/assets/irradiance.h"

namespace skybake {

using config::Outcome;
using config::Parameters;

namespace {

using config::IrradianceBake;

Outcome<Baked> bake(const Parameters& parameters, const IrradianceBake& asset,
                    const BakeOptions& options, AssetLabel label) {
    const SkyLights lights(parameters, options, [&](const config::Atmosphere& atmosphere) {
        return std::make_unique<SkyLight>(atmosphere, orders_of(asset), asset.layers, options);
    });
    return bake_of_light(lights, label.name, options, [&](const SkyLights& found) {
        return bake_irradiance(found, asset, options,
                               labelled_light_table(parameters, std::move(label)));
    });
}

std::vector<Need> needs(const Parameters& parameters, const IrradianceBake& asset, Certification) {
    if (asset.content == config::IrradianceContent::direct) return {};
    const config::SkyOrders orders = orders_of(asset);
    return light_needs(parameters, orders, orders != config::SkyOrders::multiple);
}

Estimate estimate(const Parameters&, const IrradianceBake& asset) {
    return estimate_texels(asset, asset.size, 5e-4, 3 + seconds_to_solve(asset.orders));
}

AssetPlaces places(const Parameters& parameters, const IrradianceBake& asset,
                   const StoredTexels& stored) {
    constexpr auto kConvention = TexelConvention::end_points_on_texel_centres;
    const Shell shell = shell_of(parameters.atmosphere);
    const auto mapping = asset.mapping;
    return single_lookup({"altitude_km", "sun_cos_zenith"}, [=](const Place& at) {
        const double x = sun_coordinate(mapping, at[1].second);
        const double y = irradiance_coordinate(shell, at[0].second);
        return Uvw{texture_coordinate(kConvention, x, stored.size[0]),
                   texture_coordinate(kConvention, y, stored.size[1]), 0.5};
    });
}

AssetLookup lookup(const Parameters& parameters, const IrradianceBake& asset,
                   const StoredTexels& stored) {
    const std::string thickness_km = glsl_number(shell_of(parameters.atmosphere).thickness_km);
    const bool twilight = asset.mapping == config::MultipleScatteringMapping::twilight;
    GlslFunction function;
    function.comment = fmt::format(
        "Returns what falls on a level surface that faces up, for a solar irradiance of 1. "
        "altitude_km is from 0 to {}.",
        thickness_km);
    function.arguments = "sampler2D table, float altitude_km, float sun_cos_zenith";
    function.value = fmt::format("irradiance{}(table, {}, altitude_km, sun_cos_zenith, {})",
                                 of_4(stored.channels), thickness_km, twilight);
    return {"irradiance", {with_wavelengths(stored.channels, std::move(function))}};
}

// Returns the light that comes straight from the sun onto a level surface.
Spectrum sunlight_on(const TracedAir& air, const LevelSample& at) {
    if (!(at.sun.cosine > 0)) return {};
    const AirShells& shells = air.tracer().walker().air();
    const double r = shells.planet().ground_radius_km + at.altitude_km;
    return at.sun.cosine *
           shells.sunlight(at.altitude_km, r * at.sun.cosine, shells.shell_at(at.altitude_km));
}

std::optional<TracedLight> traced(const Parameters& parameters, const IrradianceBake& asset) {
    if (orders_of(asset) == config::SkyOrders::single) return std::nullopt;
    const std::vector<LevelSample> samples = level_samples(shell_of(parameters.atmosphere));
    const auto places_in = [&](const StoredTexels& stored) {
        return places(parameters, asset, stored);
    };
    const auto trace_of = [&](const std::shared_ptr<const TracedAir>& air) -> TraceOfPlace {
        TraceOfPlace trace = trace_of_irradiance(air, samples, orders_of(asset));
        if (asset.content != config::IrradianceContent::total) return trace;
        return
            [=, of_sky = std::move(trace)](std::size_t place, const PathTracerSettings& settings) {
                PathTracedRadiance light = of_sky(place, settings);
                light.radiance += sunlight_on(*air, samples[place]);
                return light;
            };
    };
    return TracedLight{light_channels(parameters), places_of(samples),
                       light_looked_up(places_in, irradiance_probes_at(samples)),
                       traces_of_packets(parameters, trace_of)};
}

void draft(IrradianceBake& asset, int) {
    asset.size = {std::min(asset.size[0], 32), std::min(asset.size[1], 16)};
    asset.max_texel_error = std::max(asset.max_texel_error, 0.02);
}

}  // namespace

Baker<config::IrradianceBake> baker(BakerTag<config::IrradianceBake>) {
    return {.version = 14,
            .bake = bake,
            .estimate = estimate,
            .needs = needs,
            .places = places,
            .lookup = lookup,
            .traced = traced,
            .draft = draft,
            .variants = {{"size"}, {"pixel_type"}}};
}

}  // namespace skybake
