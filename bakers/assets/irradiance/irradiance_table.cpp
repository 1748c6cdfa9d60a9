#include "bakers/assets/irradiance/irradiance_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bakers/assets/registry/baker.h"
#include "bakers/assets/sky/sky_asset.h"
#include "bakers/assets/sky/traced_light.h"
#include "bakers/field/finish_table.h"
#include "bakers/field/image.h"
#include "bakers/light/multiple_scattering_mapping.h"
#include "bakers/light/sky_irradiance.h"
#include "bakers/math/relative_error.h"

namespace skybake {

using config::IrradianceBake;
using config::IrradianceContent;

namespace {

// Nodes of each level, and of the reference. Skies of spheres with forward peaks, like those of Mars, have
// one level more and a finer reference, for which others need not pay.
constexpr std::array<IrradianceNodes, 6> kNodes = {
    {{6, 6, 3}, {8, 8, 4}, {12, 12, 5}, {16, 16, 6}, {22, 22, 8}, {30, 30, 11}}};
constexpr IrradianceNodes kReferenceNodes = {28, 32, 12};
constexpr IrradianceNodes kReferenceNodesOfPeaks = {36, 40, 14};

std::size_t level_count(const SkyLight& light) {
    return light.has_peaks() ? kNodes.size() : kNodes.size() - 1;
}

const IrradianceNodes& reference_nodes(const SkyLight& light) {
    return light.has_peaks() ? kReferenceNodesOfPeaks : kReferenceNodes;
}

// Writes the channels of a row of the table, interleaved, for suns at x.
void fill_row(const SkyLight& light, const IrradianceBake& bake, const IrradianceNodes& nodes,
              double y, const std::vector<double>& x, double* values) {
    const double altitude_km = irradiance_altitude_km(light.shell(), y);
    std::vector<double> suns;
    for (const double coordinate : x) suns.push_back(sun_cos_zenith_at(bake.mapping, coordinate));
    std::vector<Spectrum> light_of(suns.size());
    if (bake.content != IrradianceContent::direct) {
        light_of = sky_irradiances(light, altitude_km, suns, nodes);
    }
    for (std::size_t i = 0; i < suns.size(); ++i) {
        if (bake.content != IrradianceContent::sky) {
            light_of[i] += sun_irradiance(light, altitude_km, suns[i]);
        }
        values = std::copy_n(data(light_of[i]), light.medium().air.channels, values);
    }
}

std::string content_text(const IrradianceBake& bake) {
    const std::string surface =
        "irradiance of a level surface that faces up, for a solar irradiance of 1 (dimensionless)";
    if (bake.content == IrradianceContent::direct) return surface + ": by the sun";
    const std::string sky = fmt::format("by the sky, {}", light_text(orders_of(bake), bake.layers));
    if (bake.content == IrradianceContent::sky) return fmt::format("{}: {}", surface, sky);
    return fmt::format("{}: by the sun and {}", surface, sky);
}

void describe(const IrradianceBake& bake, const SkyLight& light, Baked& table) {
    table.kind = "irradiance";
    table.content = content_text(bake);
    describe_sun_table(bake.mapping, "x = sqrt(altitude / (R_top - R_ground))", light.shell(),
                       table);
    set_files(bake, table);
    table.certificate.reference =
        fmt::format("the same integral with {} directions above and below the sun, and around",
                    reference_nodes(light).single);
}

Outcome<Baked> bake(const Parameters& parameters, const IrradianceBake& asset,
                    const BakeOptions& options, AssetLabel label) {
    const SkyLights lights(parameters, options, [&](const config::Atmosphere& atmosphere) {
        return std::make_unique<SkyLight>(atmosphere, orders_of(asset), asset.layers, options);
    });
    return bake_of_light(lights, label.name, options, [&] {
        return bake_irradiance(lights, asset, options,
                               labelled_light_table(parameters, std::move(label)));
    });
}

std::vector<Need> needs(const Parameters& parameters, const IrradianceBake& asset, Certification) {
    if (asset.content == config::IrradianceContent::direct) return {};
    const config::SkyOrders orders = orders_of(asset);
    return light_needs(light_packets(parameters), orders, orders != config::SkyOrders::multiple);
}

Estimate estimate(const Parameters& parameters, const IrradianceBake& asset) {
    return estimate_texels(asset, asset.size, channels_of_light(parameters), 5e-4,
                           3 + seconds_to_solve(asset.orders));
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
    function.value =
        fmt::format("irradiance{}(table, {}, {}, altitude_km, sun_cos_zenith, {})",
                    of_4(stored.channels), glsl_size(stored.size), thickness_km, twilight);
    return {"irradiance", {with_wavelengths(stored.channels, std::move(function))}};
}

std::optional<TracedLight> traced(const Parameters& parameters, const IrradianceBake& asset) {
    if (orders_of(asset) == config::SkyOrders::single) return std::nullopt;
    const std::vector<LevelSample> samples = level_samples(shell_of(parameters.atmosphere));
    const auto trace_of = [&](const std::shared_ptr<const TracedAir>& air) {
        return asset.content == config::IrradianceContent::total
                   ? trace_of_daylight(air, samples)
                   : trace_of_irradiance(air, samples, orders_of(asset));
    };
    return TracedLight{light_channels(parameters), places_of(samples),
                       light_looked_up(places, parameters, asset, irradiance_probes_at(samples)),
                       traces_of_packets(parameters, trace_of)};
}

void draft(IrradianceBake& asset, int) {
    asset.size = {std::min(asset.size[0], 32), std::min(asset.size[1], 16)};
    asset.max_texel_error = std::max(asset.max_texel_error, 0.02);
}

}  // namespace

double irradiance_altitude_km(const Shell& shell, double y) { return y * y * shell.thickness_km; }

double irradiance_coordinate(const Shell& shell, double altitude_km) {
    return std::sqrt(altitude_km / shell.thickness_km);
}

config::SkyOrders orders_of(const IrradianceBake& bake) {
    if (bake.content == IrradianceContent::direct) return config::SkyOrders::single;
    return bake.content == IrradianceContent::sky ? bake.orders : config::SkyOrders::all;
}

TableModel irradiance_model(const SkyLight& light, const IrradianceBake& bake) {
    TableModel model;
    model.channels = light.medium().air.channels;
    model.lowest = 0;
    model.highest = std::numeric_limits<double>::max();
    for (std::size_t level = 0; level < level_count(light); ++level) {
        model.cost_per_texel.push_back(2.0 * kNodes[level].single * kNodes[level].single);
    }
    model.row = [&light, bake](int level, double y, const std::vector<double>& x, double* values) {
        fill_row(light, bake, kNodes[static_cast<std::size_t>(level)], y, x, values);
    };
    model.reference = [&light, bake](double y, const std::vector<double>& x, double* values) {
        fill_row(light, bake, reference_nodes(light), y, x, values);
    };
    model.error = relative_error;
    return model;
}

Outcome<Baked> bake_irradiance(const SkyLights& lights, const IrradianceBake& bake,
                               const BakeOptions& options, Baked table) {
    const auto mapping = bake.mapping;
    const Shell shell = lights.first().shell();
    describe(bake, lights.first(), table);
    AccuracyRequest request;
    request.size = bake.size;
    request.max_texel_error = bake.max_texel_error;
    request.quick = {8, 8};
    request.full = {64, 16};
    request.quick_search = {24, 24, 4, 6, 32};
    request.full_search = {128, 64, 16, 16, 512};
    const auto place_of = [shell, mapping](double x, double y) {
        return Place{{"altitude_km", irradiance_altitude_km(shell, y)},
                     {"sun_cos_zenith", sun_cos_zenith_at(mapping, x)}};
    };
    const TableModel model =
        lights.model([&](const SkyLight& light) { return irradiance_model(light, bake); });
    return finish_table(model, request, options, place_of, std::move(table));
}

Baker<config::IrradianceBake> baker(BakerTag<config::IrradianceBake>) {
    return {.version = 19,
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
