// The baker of asset = "irradiance".
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>
#include <utility>

#include "bakers/assets/baker.h"
#include "bakers/assets/irradiance/irradiance_table.h"
#include "bakers/assets/sky_asset.h"
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
    const SkyLight light(parameters.atmosphere, orders_of(asset), asset.layers, options);
    return bake_of_light(light, label.name, options, [&](const SkyLight& found) {
        return bake_irradiance(found, asset, options, labelled_table(parameters, std::move(label)));
    });
}

Estimate estimate(const Parameters&, const IrradianceBake& asset) {
    return estimate_texels(asset, asset.size, 4e-3, 0.3 + seconds_to_solve(asset.orders));
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
    function.value = fmt::format("irradiance(table, {}, altitude_km, sun_cos_zenith, {})",
                                 thickness_km, twilight);
    return {"irradiance", {with_channels(stored.channels, 3, std::move(function))}};
}

void draft(IrradianceBake& asset, int) {
    asset.size = {std::min(asset.size[0], 32), std::min(asset.size[1], 16)};
    asset.max_texel_error = std::max(asset.max_texel_error, 0.02);
}

}  // namespace

const Baker<config::IrradianceBake>& baker(BakerTag<config::IrradianceBake>) {
    static const Baker<config::IrradianceBake> row = {.version = 3,
                                                      .bake = bake,
                                                      .estimate = estimate,
                                                      .places = places,
                                                      .lookup = lookup,
                                                      .draft = draft};
    return row;
}

}  // namespace skybake
