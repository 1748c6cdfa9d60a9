// The baker of asset = "sky_view".
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include "bakers/assets/registry/baker.h"
#include "bakers/assets/sky/sky_asset.h"
#include "bakers/assets/sky/traced_light.h"
#include "bakers/assets/sky_view/sky_view_table.h"
#include "bakers/field/image.h"
#include "bakers/light/sky_light.h"
#include "bakers/light/sky_view_mapping.h"
#include "bakers/light/strip_orders.h"
#include "bakers/math/bake_clock.h"
#include "config/assets/sky_view.h"
#include "config/text/mapped.h"

namespace skybake {
namespace {

using config::SkyViewBake;

bool is_from_strips(const SkyViewBake& asset) {
    return asset.sky == config::SkyMethod::strips && asset.orders != config::SkyOrders::single;
}

std::unique_ptr<const SkyLight> light_of_view(const config::Atmosphere& atmosphere,
                                              const SkyViewBake& asset,
                                              const BakeOptions& options) {
    if (!is_from_strips(asset)) {
        return std::make_unique<SkyLight>(atmosphere, asset.orders, asset.layers, options);
    }
    const BakeTime time(BakePart::light);
    SkyMedium medium = make_sky_medium(atmosphere);
    auto strips = std::make_unique<StripOrders>(medium, options);
    return std::make_unique<SkyLight>(std::move(medium), asset.orders, std::move(strips),
                                      options.threads);
}

Outcome<Baked> bake(const Parameters& parameters, const SkyViewBake& asset,
                    const BakeOptions& options, AssetLabel label) {
    const SkyLights lights(parameters, options, [&](const config::Atmosphere& atmosphere) {
        return light_of_view(atmosphere, asset, options);
    });
    return bake_of_light(lights, label.name, options, [&] {
        return bake_sky_view(lights, asset, options,
                             labelled_light_table(parameters, std::move(label)));
    });
}

std::vector<Need> needs(const Parameters& parameters, const SkyViewBake& asset, Certification) {
    if (is_from_strips(asset)) return {};
    return light_needs(light_packets(parameters), asset.orders, true);
}

Estimate estimate(const Parameters& parameters, const SkyViewBake& asset) {
    const std::array<int, 2> size = {asset.size[0],
                                     asset.size[1] * static_cast<int>(asset.sun_elevations.size())};
    return estimate_texels(asset, size, channels_of_light(parameters), 3e-5,
                           0.3 + seconds_to_solve(asset.orders));
}

// In the table of the sun that the probe names: the nearest, since its angle went through degrees.
Uvw place_of(const SkyViewBake& asset, const Shell& shell, int width, const Probe& probe) {
    const SkyViewCamera camera(shell, asset.altitude.kilometers());
    const double radians = std::numbers::pi / 180;
    const auto suns = static_cast<int>(asset.sun_elevations.size());
    Uvw nearest{};
    bool any = false;
    for (int k = 0; k < suns; ++k) {
        const double elevation = asset.sun_elevations[static_cast<std::size_t>(k)].radians;
        if (std::fabs(elevation - probe.at[2].second * radians) > 1e-9) continue;
        const double y = camera.coordinate(probe.at[1].second * radians);
        const double v = (k + sky_view_v(y, asset.size[1])) / suns;
        // The same sun may stand in the list twice.
        if (any && std::fabs(v - probe.uvw[1]) > std::fabs(nearest[1] - probe.uvw[1])) continue;
        any = true;
        nearest = {texture_coordinate(TexelConvention::end_points_on_texel_centres,
                                      probe.at[0].second / 180, width),
                   v, 0.5};
    }
    return nearest;
}

AssetPlaces places(const Parameters& parameters, const SkyViewBake& asset,
                   const StoredTexels& stored) {
    const Shell shell = shell_of(parameters.atmosphere);
    return AssetPlaces{
        {"azimuth_deg", "above_horizon_deg", "sun_elevation_deg"}, [=](const Probe& probe, int) {
            return std::vector<ProbeLookup>{{place_of(asset, shell, stored.size[0], probe)}};
        }};
}

AssetLookup lookup(const Parameters& parameters, const SkyViewBake& asset,
                   const StoredTexels& stored) {
    const std::size_t suns = asset.sun_elevations.size();
    std::vector<double> elevations_deg;
    for (const config::Angle& elevation : asset.sun_elevations) {
        elevations_deg.push_back(to_digits(elevation.radians * 180 / std::numbers::pi, 9));
    }
    GlslFunction function;
    function.comment = fmt::format(
        "Returns the radiance of the sky or of the ground in 1/sr, for a solar irradiance of 1, "
        "seen from an altitude of {} km. The unit vectors point along the view ray, away from the "
        "planet's centre and to the sun, which is at an elevation of {} degrees.{}",
        glsl_number(asset.altitude.kilometers()), fmt::join(elevations_deg, " or "),
        suns > 1 ? " `sun` is to be the k-th of these, from 0 on." : "");
    function.arguments = "sampler2D table, vec3 dir, vec3 up, vec3 sun";
    if (suns > 1) function.arguments += ", int k";
    function.value =
        fmt::format("sky_view{}(table, {}, {}, {}, dir, up, sun, {}, {})", of_4(stored.channels),
                    glsl_size(std::array{stored.size[0], stored.size[1] / static_cast<int>(suns)}),
                    glsl_shell(shell_of(parameters.atmosphere)),
                    glsl_number(asset.altitude.kilometers()), suns > 1 ? "k" : "0", suns);
    return {"sky_view", {with_wavelengths(stored.channels, std::move(function))}};
}

std::optional<TracedLight> traced(const Parameters& parameters, const SkyViewBake& asset) {
    if (asset.orders == config::SkyOrders::single) return std::nullopt;
    const auto elevations_deg = mapped<double>(
        asset.sun_elevations,
        [&](const config::Angle& elevation) { return elevation.radians * kDegreesPerRadian; });
    // Traces every direction for one or two suns, and every n-th for more.
    const auto stride = static_cast<int>((elevations_deg.size() + 1) / 2);
    const std::vector<SkySample> samples = sky_samples(
        shell_of(parameters.atmosphere), {asset.altitude.kilometers()}, elevations_deg, stride);
    auto at = mapped<Place>(samples, [&](const SkySample& sample) {
        return Place{{"azimuth_deg", sample.azimuth_deg},
                     {"above_horizon_deg", sample.above_horizon_deg},
                     {"sun_elevation_deg", sample.sun_elevation_deg}};
    });
    return traced_sky(parameters, samples, asset.orders,
                      light_looked_up(places, parameters, asset, std::move(at)));
}

void draft(SkyViewBake& asset, int) {
    asset.size = {std::min(asset.size[0], 96), std::min(asset.size[1], 54)};
}

}  // namespace

Baker<config::SkyViewBake> baker(BakerTag<config::SkyViewBake>) {
    return {.version = 19,
            .bake = bake,
            .estimate = estimate,
            .needs = needs,
            .places = places,
            .lookup = lookup,
            .traced = traced,
            .draft = draft,
            .variants = {{"size"}, {"pixel_type"}, {"sky", "strips", "Ai et al. 2014"}}};
}

}  // namespace skybake
