// The baker of asset = "environment".
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bakers/assets/cloud_light/march_light.h"
#include "bakers/assets/environment/environment_clouds.h"
#include "bakers/assets/environment/environment_mapping.h"
#include "bakers/assets/environment/environment_table.h"
#include "bakers/assets/registry/baker.h"
#include "bakers/assets/sky/sky_asset.h"
#include "bakers/assets/sky/traced_light.h"
#include "bakers/assets/sources/source_volume.h"
#include "bakers/light/sky_light.h"
#include "bakers/light/sky_view_mapping.h"
#include "config/assets/environment.h"
#include "config/sections/parameters.h"

namespace skybake {

using config::EnvironmentBake;
using config::EnvironmentMapping;

namespace {

Outcome<Baked> bake(const Parameters& parameters, const EnvironmentBake& asset,
                    const BakeOptions& options, AssetLabel label) {
    SkyLights lights(parameters, options, [&](const config::Atmosphere& atmosphere) {
        return std::make_unique<SkyLight>(atmosphere, asset.orders, asset.layers, options);
    });
    lights.multiply(solar_irradiance_of(asset));
    return bake_of_light(lights, label.name, options, [&] {
        Baked table = labelled_light_table(parameters, std::move(label));
        // The lights tell the lux of colours.
        if (lights.makes_colors()) {
            table.conventions.color = color_convention(*parameters.color, {}, true);
        }
        const Outcome<std::vector<CloudMedium>> media =
            clouds_of_environment(parameters, asset, options, table.details);
        if (!media.value) return Outcome<Baked>{{}, media.diagnostics};
        return bake_environment(lights, asset, options, std::move(table), *media.value);
    });
}

std::vector<Need> needs(const Parameters& parameters, const EnvironmentBake& asset, Certification) {
    std::vector<Need> needs = light_needs(light_packets(parameters), asset.orders, true);
    for (const std::string& clouds : asset.clouds) {
        std::ranges::move(needs_of_voxels(parameters, source_volume(parameters, clouds)),
                          std::back_inserter(needs));
    }
    return needs;
}

Estimate estimate(const Parameters& parameters, const EnvironmentBake& asset) {
    Estimate result = estimate_texels(asset, asset.size, channels_of_light(parameters), 3e-6,
                                      0.3 + seconds_to_solve(asset.orders));
    constexpr double kSecondsPerRay = 4e-6;
    const double texels = double(asset.size[0]) * asset.size[1];
    const double rays = texels * asset.samples * asset.samples / 2;
    for (const std::string& clouds : asset.clouds) {
        const CloudVolumeBake& of = source_volume(parameters, clouds);
        const Estimate voxels = estimate_cloud_volume(parameters, of);
        const Estimate light = cloud_light::march_light_estimate(voxels_of(of.size, 1));
        result.seconds += voxels.seconds + light.seconds + kSecondsPerRay * rays;
        // The voxels, as they are made and as they are marched, and what texels see of them.
        result.memory_mib += voxels.memory_mib + light.memory_mib +
                             (8 * voxels_of(of.size, 1) + 24 * texels) / kMebibyte;
    }
    return result;
}

// A lookup of a part stays within it.
Uvw uvw_in_part(const EnvironmentLayout& layout, int level, const MapAngles& angles) {
    const EnvironmentLayout::At at = layout.at(direction_of_angles(angles));
    const double margin = 0.5 / std::max(layout.part_size().columns >> level, 1);
    const double x = std::clamp(at.x, margin, 1 - margin);
    const double y = std::clamp(at.y, margin, 1 - margin);
    return {x, (at.part + y) / layout.parts(), 0.5};
}

AssetPlaces places(const Parameters&, const EnvironmentBake& asset, const StoredTexels&) {
    const std::vector<std::string> names = {"azimuth_deg", "elevation_deg"};
    if (asset.mapping == EnvironmentMapping::longitude_latitude) {
        return single_lookup(names, [](const Place& at) {
            return Uvw{at[0].second / 360 + 0.5, 0.5 - at[1].second / 180, 0.5};
        });
    }
    const EnvironmentLayout layout(asset.mapping, asset.size);
    return {names, [layout](const Probe& probe, int level) {
                const MapAngles angles = {probe.at[0].second / kDegreesPerRadian,
                                          probe.at[1].second / kDegreesPerRadian};
                return std::vector<ProbeLookup>{{uvw_in_part(layout, level, angles)}};
            }};
}

AssetLookup lookup(const Parameters&, const EnvironmentBake& asset, const StoredTexels& stored) {
    const bool is_square = asset.mapping != EnvironmentMapping::longitude_latitude;
    const std::string_view ahead = is_square || !looks_to_the_sun(asset) ? "ahead" : "sun";
    const double sun_deg = to_digits(asset.sun_elevation.radians * kDegreesPerRadian, 9);
    GlslFunction function;
    function.comment = fmt::format(
        "Returns the radiance of the sky{} or of the ground in {}, "
        "seen from an altitude of {} km. The unit vectors point along the view ray, away from the "
        "planet's centre and ",
        asset.has_clouds() ? ", of clouds" : "",
        asset.solar_irradiance.empty() ? "1/sr, for a solar irradiance of 1"
                                       : "the bake's solar_irradiance/sr",
        glsl_number(asset.altitude.kilometers()));
    function.comment +=
        ahead == "sun"
            ? fmt::format("to the sun, which is at an elevation of {} degrees.", sun_deg)
            : fmt::format(
                  "straight ahead. The sun is at an elevation of {} degrees and {} degrees "
                  "to the right of ahead.",
                  sun_deg, to_digits(asset.sun_azimuth.radians * kDegreesPerRadian, 9));
    function.arguments = fmt::format("sampler2D table, vec3 dir, vec3 up, vec3 {}", ahead);
    function.value = fmt::format("environment{}{}(table, {}dir, up, {})",
                                 is_square ? "_" + stored.mapping : "", of_4(stored.channels),
                                 is_square ? glsl_number(stored.size[0]) + ", " : "", ahead);
    return {"environment", {with_wavelengths(stored.channels, std::move(function))}};
}

// The path tracer knows neither clouds nor the sun's disc, so these have no sky error.
std::optional<TracedLight> traced(const Parameters& parameters, const EnvironmentBake& asset) {
    if (asset.orders == config::SkyOrders::single || asset.has_clouds() ||
        asset.sun == config::SunInMap::disc) {
        return std::nullopt;
    }
    const Shell shell = shell_of(parameters.atmosphere);
    const double altitude_km = asset.altitude.kilometers();
    const double dip_deg = SkyViewCamera(shell, altitude_km).dip() * kDegreesPerRadian;
    const std::vector<SkySample> samples =
        sky_samples(shell, altitude_km, asset.sun_elevation.radians * kDegreesPerRadian);
    std::vector<Place> at;
    for (const SkySample& sample : samples) {
        // Every other view is to the left of the sun.
        const double side = at.size() % 2 == 0 ? 1 : -1;
        const double azimuth_deg =
            asset.sun_azimuth.radians * kDegreesPerRadian + side * sample.azimuth_deg;
        at.push_back({{"azimuth_deg", std::remainder(azimuth_deg, 360)},
                      {"elevation_deg", sample.above_horizon_deg - dip_deg}});
    }
    return traced_sky(parameters, samples, asset.orders,
                      per_irradiance(light_looked_up(places, parameters, asset, std::move(at)),
                                     solar_irradiance_of(asset)));
}

void draft(EnvironmentBake& asset, int) {
    asset.samples = 1;
    if (asset.mapping == EnvironmentMapping::longitude_latitude) {
        asset.size = {std::min(asset.size[0], 128), std::min(asset.size[1], 64)};
        return;
    }
    const int edge = std::min(asset.size[0], 64);
    asset.size = {edge, asset.mapping == EnvironmentMapping::cube ? 6 * edge : edge};
    asset.mips = 1;
    asset.level_content = config::LevelContent::mean;
}

std::vector<InputFile> inputs(const Parameters& parameters, const EnvironmentBake& asset) {
    std::vector<InputFile> files;
    for (const std::string& clouds : asset.clouds) {
        std::ranges::move(cloud_volume_inputs(parameters, source_volume(parameters, clouds)),
                          std::back_inserter(files));
    }
    return files;
}

}  // namespace

Baker<EnvironmentBake> baker(BakerTag<EnvironmentBake>) {
    return {.version = 25,
            .bake = bake,
            .estimate = estimate,
            .needs = needs,
            .places = places,
            .lookup = lookup,
            .traced = traced,
            .draft = draft,
            .inputs = inputs,
            .variants = {{"size"}, {"pixel_type"}}};
}

}  // namespace skybake
