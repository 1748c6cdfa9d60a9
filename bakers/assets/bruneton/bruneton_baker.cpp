// The baker of asset = "bruneton".
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "bakers/air/forward_peak.h"
#include "bakers/air/transmittance_mapping.h"
#include "bakers/assets/bruneton/bruneton_volume.h"
#include "bakers/assets/bruneton/scattering_content.h"
#include "bakers/assets/bruneton/scattering_table.h"
#include "bakers/assets/bruneton/scattering_volume.h"
#include "bakers/assets/bruneton/table_content.h"
#include "bakers/assets/registry/baker.h"
#include "bakers/assets/sky/sky_lights.h"
#include "bakers/assets/sky/traced_light.h"
#include "bakers/field/baked.h"
#include "bakers/light/sky_radiance.h"
#include "bakers/light/sky_view_mapping.h"
#include "config/assets/bruneton.h"
#include "config/assets/transmittance.h"

namespace skybake {
namespace {

constexpr auto kAtTexelCentres = TexelConvention::end_points_on_texel_centres;

Outcome<Baked> bake(const Parameters& parameters, const BrunetonBake& asset,
                    const BakeOptions& options, AssetLabel label) {
    PacketsOfAir air{light_packets(parameters)};
    if (holds_colors(parameters)) {
        const auto colors = colors_of(parameters, options);
        if (!colors) return {};
        air.weights = colors->weights;
    }
    return bake_bruneton(air, asset, options, labelled_sky_volume(parameters, std::move(label)));
}

std::vector<Need> needs(const Parameters& parameters, const BrunetonBake& asset, Certification) {
    return needs_of_bruneton(light_packets(parameters), asset);
}

Estimate estimate(const Parameters& parameters, const BrunetonBake& asset) {
    const bool has_light = asset.table != BrunetonTable::transmittance;
    Estimate result = estimate_volume(asset, asset.size, 4, has_light ? 4e-6 : 2e-7);
    if (has_light) result.seconds += kSecondsToSolve;
    const auto packets = static_cast<double>(light_packets(parameters).size());
    result.seconds *= packets;
    // All are held, with their first and higher orders apart, while the next orders are made of them.
    const double copies = asset.size[2] > 1 ? 4 : 1;
    const double bytes = copies * 4 * sizeof(float) * voxels_of(asset.size, 1);
    result.memory_mib += packets * bytes / kMebibyte;
    return result;
}

AssetPlaces places(const Parameters& parameters, const BrunetonBake& asset, const StoredTexels&) {
    const Shell shell = shell_of(parameters.atmosphere);
    const std::array<int, 3> size = asset.size;
    const auto flat = [size](double x, double y) {
        return Uvw{texture_coordinate(kAtTexelCentres, x, size[0]),
                   texture_coordinate(kAtTexelCentres, y, size[1]), 0.5};
    };
    if (asset.table == BrunetonTable::transmittance) {
        return single_lookup({"altitude_km", "cos_zenith"}, [shell, flat](const Place& at) {
            const UnitCoordinates x = transmittance_coordinates(shell, at[0].second, at[1].second);
            return flat(x.x_mu, x.x_r);
        });
    }
    if (asset.table == BrunetonTable::irradiance) {
        return single_lookup({"altitude_km", "sun_cos_zenith"}, [shell, flat](const Place& at) {
            return flat(0.5 * (at[1].second + 1), at[0].second / shell.thickness_km);
        });
    }
    const ScatteringMapping mapping(shell, size, asset.nu_size, asset.sun_cos_zenith_min);
    return AssetPlaces{{"altitude_km", "cos_zenith", "sun_cos_zenith", "nu", "ground"},
                       [mapping](const Probe& probe, int) {
                           const Place& at = probe.at;
                           return scattering_lookups(
                               mapping,
                               scattering_place(mapping, at[0].second, at[1].second, at[2].second,
                                                at[3].second, at[4].second != 0));
                       }};
}

AssetLookup irradiance_lookup(const std::string& thickness_km, const StoredTexels& stored) {
    GlslFunction function;
    function.comment = fmt::format(
        "Returns the irradiance by the sky without the sun of a level surface that faces up, times "
        "the solar irradiance. altitude_km is from 0 to {}.",
        thickness_km);
    function.arguments = "sampler2D table, float altitude_km, float sun_cos_zenith";
    function.value = fmt::format(
        "bruneton_irradiance{}(table, {}, {}, altitude_km, sun_cos_zenith)", of_4(stored.channels),
        glsl_size(std::span(stored.size).first(2)), thickness_km);
    return {"bruneton", {with_wavelengths(stored.channels, std::move(function))}};
}

AssetLookup lookup(const Parameters& parameters, const BrunetonBake& asset,
                   const StoredTexels& stored) {
    const Shell shell = shell_of(parameters.atmosphere);
    const std::string thickness_km = glsl_number(shell.thickness_km);
    if (asset.table == BrunetonTable::transmittance) {
        return baker(BakerTag<config::TransmittanceBake>{})
            .lookup(parameters, {},
                    {stored.mapping, {stored.size[0], stored.size[1]}, stored.channels});
    }
    if (asset.table == BrunetonTable::irradiance) return irradiance_lookup(thickness_km, stored);
    GlslFunction function;
    function.comment = fmt::format(
        "Returns the table's channels, of which the first lines above say what the sky is. "
        "altitude_km is from 0 to {}, nu is the cosine of the angle between the view ray and the "
        "direction to the sun, and `ground` says that the view ray meets the ground.",
        thickness_km);
    function.arguments =
        "sampler3D table, float altitude_km, float cos_zenith, float sun_cos_zenith, float nu, "
        "bool ground";
    function.value = fmt::format(
        "bruneton_scattering(table, {}, {}, altitude_km, cos_zenith, sun_cos_zenith, nu, ground, "
        "{}, {})",
        glsl_size(stored.size), glsl_shell(shell), glsl_number(asset.sun_cos_zenith_min),
        glsl_number(asset.nu_size));
    return {"bruneton", {with_channels(stored.channels, 4, std::move(function))}};
}

std::optional<TracedLight> traced_irradiance(const Parameters& parameters,
                                             const BrunetonBake& asset) {
    const std::vector<LevelSample> samples = level_samples(shell_of(parameters.atmosphere));
    return TracedLight{
        light_channels(parameters), places_of(samples),
        per_irradiance(light_looked_up(places, parameters, asset, irradiance_probes_at(samples)),
                       asset.solar_irradiance),
        traces_of_packets(parameters, [&](std::shared_ptr<const TracedAir> air) {
            return trace_of_irradiance(std::move(air), samples, config::SkyOrders::all);
        })};
}

// Cameras near the ground, in the middle of the air and high above, under suns of the table.
std::vector<SkySample> samples_of(const Shell& shell, const BrunetonBake& asset) {
    std::vector<double> suns_deg = {75, 30, 10, 2, -2, -5};
    std::erase_if(suns_deg, [&](double sun) {
        return cosine_of((90 - sun) / kDegreesPerRadian) < asset.sun_cos_zenith_min;
    });
    std::vector<double> altitudes_km;
    for (const double share : {0.005, 0.08, 0.5})
        altitudes_km.push_back(share * shell.thickness_km);
    return sky_samples(shell, altitudes_km, suns_deg, 7);
}

// The light scattered once that a table holds: by all layers, by none, or by those that are not
// Mie's.
enum class FirstOrder { of_all_layers, of_no_layer, without_mie };

FirstOrder first_order_of(const BrunetonBake& asset) {
    if (asset.table == BrunetonTable::higher_orders) return FirstOrder::of_no_layer;
    return asset.combined ? FirstOrder::of_all_layers : FirstOrder::without_mie;
}

// The sky's radiance by paths, with the first order that the table holds.
TraceOfPlace trace_of_table(std::shared_ptr<const TracedAir> air, std::vector<SkySample> samples,
                            const BrunetonBake& asset) {
    const FirstOrder first = first_order_of(asset);
    if (first == FirstOrder::of_all_layers) {
        return trace_of_sky(air, samples, config::SkyOrders::all, false);
    }
    std::vector<std::string> others;
    for (const SkyLayer& layer : air->medium().layers) {
        const auto& mie = asset.mie_layers;
        if (std::ranges::find(mie, layer.name) == mie.end()) others.push_back(layer.name);
    }
    const bool adds_first = first == FirstOrder::without_mie && !others.empty();
    const auto by_others =
        std::make_shared<const SkyMedium>(scattering_only(air->medium(), others));
    return [=, higher = trace_of_sky(air, samples, config::SkyOrders::multiple, false)](
               std::size_t place, const PathTracerSettings& settings) {
        PathTracedRadiance light = higher(place, settings);
        const SkySample& at = samples[place];
        if (adds_first) {
            light.radiance += SkyIntegrator(*by_others, nullptr)
                                  .radiance(at.altitude_km, at.sun, at.direction)
                                  .single;
        }
        return light;
    };
}

std::optional<TracedLight> traced_scattering(const Parameters& parameters,
                                             const BrunetonBake& asset) {
    const Shell shell = shell_of(parameters.atmosphere);
    const std::vector<SkySample> samples = samples_of(shell, asset);
    std::vector<std::shared_ptr<const TracedAir>> airs;
    const auto traces = traces_of_packets(parameters, [&](std::shared_ptr<const TracedAir> air) {
        airs.push_back(air);
        return trace_of_table(std::move(air), samples, asset);
    });
    LightAtPlaces found =
        sky_of_scattering(std::move(airs), asset, places(parameters, asset, {}), samples);
    return TracedLight{light_channels(parameters), places_of(samples), std::move(found), traces};
}

std::optional<TracedLight> traced(const Parameters& parameters, const BrunetonBake& asset) {
    if (asset.table == BrunetonTable::transmittance || asset.table == BrunetonTable::single_mie ||
        asset.orders == 1) {
        return std::nullopt;
    }
    return asset.table == BrunetonTable::irradiance ? traced_irradiance(parameters, asset)
                                                    : traced_scattering(parameters, asset);
}

// The sub-images along u stay whole.
void draft(BrunetonBake& asset, int) {
    if (asset.table == BrunetonTable::transmittance || asset.table == BrunetonTable::irradiance) {
        return;
    }
    const int suns = asset.size[0] / asset.nu_size;
    asset.size = {asset.nu_size * std::min(suns, 16), std::min(asset.size[1], 64),
                  std::min(asset.size[2], 16)};
    asset.mips = 1;
}

}  // namespace

Baker<BrunetonBake> baker(BakerTag<BrunetonBake>) {
    return {.version = 17,
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
