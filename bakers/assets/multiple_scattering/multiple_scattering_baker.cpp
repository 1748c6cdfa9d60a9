// The baker of asset = "multiple_scattering".
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bakers/air/forward_peak.h"
#include "bakers/air/medium.h"
#include "bakers/assets/multiple_scattering/multiple_scattering_table.h"
#include "bakers/assets/multiple_scattering/solved_scattering_table.h"
#include "bakers/assets/registry/baker.h"
#include "bakers/assets/sky/traced_light.h"
#include "bakers/field/baked.h"
#include "bakers/light/higher_orders.h"
#include "bakers/light/multiple_scattering_mapping.h"
#include "bakers/light/sky_radiance.h"
#include "bakers/light/solver/solved_light.h"
#include "bakers/math/parallel.h"
#include "config/assets/multiple_scattering.h"

namespace skybake {
namespace {

using config::MultipleScatteringBake;

Outcome<Baked> bake(const Parameters& parameters, const MultipleScatteringBake& asset,
                    const BakeOptions& options, AssetLabel label) {
    Baked table = labelled_table(parameters, std::move(label));
    if (is_solved(asset)) {
        return bake_solved_scattering(parameters.atmosphere, parameters.scene, asset, options,
                                      std::move(table));
    }
    return bake_multiple_scattering(make_medium(parameters.atmosphere), asset, options,
                                    std::move(table));
}

std::vector<Need> needs(const Parameters& parameters, const MultipleScatteringBake& asset,
                        Certification certification) {
    if (!is_solved(asset)) return {};
    return needs_of_solved_scattering(parameters.atmosphere, asset, certification);
}

Estimate estimate(const Parameters& parameters, const MultipleScatteringBake& asset) {
    const std::size_t channels = parameters.atmosphere.ground_albedo.size();
    if (!is_solved(asset)) return estimate_table(asset, channels, 1e-4, 0.1);
    const std::array<int, 2> size =
        asset.max_error ? std::array<int, 2>{}
                        : std::array<int, 2>{asset.size[0], asset.size[1] * tables_of(asset)};
    return estimate_texels(asset, size, channels, 1e-6, 2 * kSecondsToSolve);
}

// Moments are in the table of the probe's l and m.
AssetPlaces places(const Parameters& parameters, const MultipleScatteringBake& asset,
                   const StoredTexels& stored) {
    constexpr auto kConvention = TexelConvention::end_points_on_texel_centres;
    const double thickness_km = shell_of(parameters.atmosphere).thickness_km;
    const SunColumns columns = sun_columns_of(parameters, asset);
    const int tables = tables_of(asset);
    std::vector<std::string> names = {"altitude_km", "sun_cos_zenith"};
    if (tables > 1) names.insert(names.end(), {"l", "m"});
    return single_lookup(std::move(names), [=](const Place& at) {
        const int part = tables == 1 ? 0
                                     : moment_index(static_cast<int>(at[2].second),
                                                    static_cast<int>(at[3].second));
        const double v =
            texture_coordinate(kConvention, at[0].second / thickness_km, stored.size[1] / tables);
        const double x = columns.coordinate(at[1].second);
        return Uvw{texture_coordinate(kConvention, x, stored.size[0]), (part + v) / tables, 0.5};
    });
}

// The arguments of the published lookups between the table and the place in it, and behind that.
struct SunArguments {
    std::string thickness_km;
    std::string axis;  // the mapping and the crop
};

SunArguments sun_arguments(const Parameters& parameters, const MultipleScatteringBake& asset) {
    const SunColumns columns = sun_columns_of(parameters, asset);
    const bool twilight = asset.mapping == config::MultipleScatteringMapping::twilight;
    return {glsl_number(shell_of(parameters.atmosphere).thickness_km),
            fmt::format("{}, vec2({}, {})", twilight, glsl_number(columns.first),
                        glsl_number(columns.last - columns.first))};
}

AssetLookup moment_lookup(const MultipleScatteringBake& asset, const SunArguments& sun,
                          const StoredTexels& stored) {
    const int count = moment_count(asset.degree);
    const std::string tables = glsl_number(count);
    GlslFunction moment;
    moment.comment = fmt::format(
        "Returns the moment M_lm of the light, in 1/sr. `part` is l (l + 1) / 2 + m, from 0 to {}; "
        "altitude_km is from 0 to {}.",
        count - 1, sun.thickness_km);
    moment.arguments = "sampler2D table, float altitude_km, float sun_cos_zenith, int part";
    moment.before = fmt::format(
        "    vec2 place = moment_place({}, {}, altitude_km, sun_cos_zenith,\n"
        "                              {});\n",
        glsl_size(std::array{stored.size[0], stored.size[1] / count}), sun.thickness_km, sun.axis);
    GlslFunction scattered = moment;
    const std::string_view suffix = of_4(stored.channels);
    moment.value = fmt::format("moment{}(table, place, {}, float(part))", suffix, tables);
    scattered.comment =
        "Returns what a km of a layer with a scattering coefficient of 1/km and the Legendre "
        "moments chi, of degree 0 to 2, scatters into the view ray, in 1/sr.";
    scattered.arguments =
        "sampler2D table, float altitude_km, float sun_cos_zenith, float view_cos_zenith, float "
        "azimuth_cosine, vec3 chi";
    scattered.value =
        fmt::format("scattered_again{}(table, place, {}, view_cos_zenith, azimuth_cosine, chi)",
                    suffix, tables);
    scattered.suffix = "_scattered";
    AssetLookup lookup = {"moments", {with_wavelengths(stored.channels, std::move(moment))}};
    // At a higher degree this function would leave moments out.
    if (asset.degree == 2) {
        lookup.functions.push_back(with_wavelengths(stored.channels, std::move(scattered)));
    }
    return lookup;
}

AssetLookup lookup(const Parameters& parameters, const MultipleScatteringBake& asset,
                   const StoredTexels& stored) {
    const SunArguments sun = sun_arguments(parameters, asset);
    if (tables_of(asset) > 1) return moment_lookup(asset, sun, stored);
    GlslFunction function;
    function.comment = fmt::format(
        "Returns the light scattered twice or more in 1/sr, to be multiplied by the scattering "
        "coefficient alone. altitude_km is from 0 to {}.",
        sun.thickness_km);
    function.arguments = "sampler2D table, float altitude_km, float sun_cos_zenith";
    function.value =
        fmt::format("multiple_scattering{}(table, {}, {}, altitude_km, sun_cos_zenith, {})",
                    of_4(stored.channels), glsl_size(stored.size), sun.thickness_km, sun.axis);
    return {"multiple_scattering", {with_wavelengths(stored.channels, std::move(function))}};
}

// Cameras near the ground, in the scene unless it is null.
std::vector<SkySample> samples_of(const Shell& shell, const config::Scene* scene) {
    constexpr double kCameraShare = 0.005;  // of the shell's thickness: 500 m on Earth
    double altitude_km = kCameraShare * shell.thickness_km;
    std::vector<double> suns_deg = {90, 60, 30, 10, 2, -2, -4, -6};
    if (scene) {
        altitude_km = std::min(std::clamp(altitude_km, scene->altitude[0].kilometers(),
                                          scene->altitude[1].kilometers()),
                               shell.thickness_km);
        const double lowest_deg = scene->sun_elevation[0].radians * kDegreesPerRadian;
        const double highest_deg = scene->sun_elevation[1].radians * kDegreesPerRadian;
        std::erase_if(suns_deg, [=](double sun) { return sun > highest_deg || sun < lowest_deg; });
        suns_deg.insert(suns_deg.end(), {lowest_deg, highest_deg});
    }
    return sky_samples(shell, {altitude_km}, suns_deg, 4);
}

// The radiance of the air, made with the table as a runtime makes it.
std::vector<Spectrum> sky_of_table(const SkyMedium& medium, const HigherOrders& orders,
                                   const std::vector<SkySample>& samples, int threads) {
    const SkyIntegrator integrator(medium, &orders);
    std::vector<Spectrum> sky(samples.size());
    parallel_for(static_cast<int>(samples.size()), threads, [&](int i) {
        const SkySample& at = samples[static_cast<std::size_t>(i)];
        const SkyRadiance light = integrator.radiance(at.altitude_km, at.sun, at.direction);
        sky[static_cast<std::size_t>(i)] = light.single + light.multiple;
    });
    return sky;
}

// Says what has a smaller error of the sky. examples/assets/multiple_scattering.md has the figures,
// those of spheres for the dust of Mars.
std::string better_than(const MultipleScatteringBake& asset, const SkyMedium& medium) {
    if (has_peaks_of_spheres(medium)) {
        return "moments do not hold the forward peaks of this air's spheres: asset = \"bruneton\" "
               "and asset = \"sky_view\" keep them apart, with half of this error";
    }
    if (!is_solved(asset)) return "method = \"solved\" has a smaller error, with the same lookup";
    if (tables_of(asset) > 1) return "";
    return "content = \"moments\" has a third to two thirds of the sky's error, for six lookups in "
           "place of one";
}

std::optional<TracedLight> traced(const Parameters& parameters,
                                  const MultipleScatteringBake& asset) {
    const Shell shell = shell_of(parameters.atmosphere);
    const config::Scene* scene =
        is_solved(asset) && parameters.scene ? &*parameters.scene : nullptr;
    const auto air = std::make_shared<const TracedAir>(parameters.atmosphere);
    const std::vector<SkySample> samples = samples_of(shell, scene);
    const auto found = [=, &parameters, &asset](const Baked& table, int threads) {
        const auto orders = stored_orders(parameters, asset, air->medium(), table.image());
        return sky_of_table(air->medium(), *orders, samples, threads);
    };
    return TracedLight{air->medium().air.channels,
                       places_of(samples),
                       found,
                       {trace_of_sky(air, samples, config::SkyOrders::all, false)},
                       better_than(asset, air->medium())};
}

void draft(MultipleScatteringBake& asset, int) {
    reduce_table(asset, {32, 32});
    asset.max_texel_error = std::max(asset.max_texel_error, 0.02);
}

}  // namespace

Baker<config::MultipleScatteringBake> baker(BakerTag<config::MultipleScatteringBake>) {
    return {.version = 18,
            .bake = bake,
            .estimate = estimate,
            .needs = needs,
            .places = places,
            .lookup = lookup,
            .traced = traced,
            .draft = draft,
            .variants = {{"size"},
                         {"pixel_type"},
                         {"mapping"},
                         {"content"},
                         {"degree"},
                         {"method", "converged", "Hillaire 2020"}}};
}

}  // namespace skybake
