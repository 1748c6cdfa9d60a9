// The baker of asset = "cloud_light".
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bakers/assets/cloud_light/cloud_layer.h"
#include "bakers/assets/cloud_light/cloud_light_truth.h"
#include "bakers/assets/cloud_light/cloud_light_volume.h"
#include "bakers/assets/cloud_light/depth_sweep.h"
#include "bakers/assets/cloud_light/layer_sky.h"
#include "bakers/assets/cloud_light/radiance_volume.h"
#include "bakers/assets/cloud_volume/cloud_volume.h"
#include "bakers/assets/occupancy/occupancy_grid.h"
#include "bakers/assets/registry/baker.h"
#include "bakers/assets/sources/source_volume.h"
#include "bakers/field/baked.h"
#include "config/assets/cloud_light.h"
#include "config/assets/cloud_volume.h"
#include "config/sections/parameters.h"

namespace skybake {
namespace {

bool is_map(const CloudLightBake& asset) { return asset.contents == CloudLightContents::shadow; }

std::optional<Need> shared_solution(const Parameters& parameters, const CloudLightBake& asset) {
    const CloudVolumeBake& of = source_volume(parameters, asset.of);
    const NeedKey voxels = needs_of_voxels(parameters, of).front().key;
    return cloud_light::solution_need({voxels, of.size, of.pixel_type}, asset);
}

Outcome<Baked> bake(const Parameters& parameters, const CloudLightBake& asset,
                    const BakeOptions& options, AssetLabel label) {
    const CloudVolumeBake& of = source_volume(parameters, asset.of);
    Baked volume = labelled_volume(std::move(label));
    const Outcome<Baked> held = hold_source_volume(parameters, asset.of, options, volume.details);
    if (!held.value) return {{}, held.diagnostics};
    const Baked& voxels = *held.value;
    const Cloud cloud = spanned_cloud(parameters, of);
    cloud_light::CloudLayer layer =
        cloud_light::make_layer(voxels, channel_named(voxels, asset.channel), cloud, options);
    if (options.cancelled()) return {};
    if (auto problem =
            cloud_light::add_sky(parameters, asset, cloud, volume.name, options, layer)) {
        return *std::move(problem);
    }
    if (options.cancelled()) return {};
    if (const auto solution = shared_solution(parameters, asset)) layer.solution = solution->key;
    if (!asset.max_error) {
        return bake_cloud_light(voxels, layer, asset, options, std::move(volume));
    }
    const Outcome<int> cell = largest_cell(layer, asset, volume.name, options);
    if (!cell.value) return {{}, cell.diagnostics};
    CloudLightBake chosen = asset;
    chosen.cell = *cell.value;
    return bake_cloud_light(voxels, layer, chosen, options, std::move(volume));
}

std::vector<Need> needs(const Parameters& parameters, const CloudLightBake& asset, Certification) {
    std::vector<Need> needs = cloud_light::sky_needs(parameters, asset);
    if (auto solution = shared_solution(parameters, asset)) needs.push_back(*std::move(solution));
    std::ranges::move(needs_of_voxels(parameters, source_volume(parameters, asset.of)),
                      std::back_inserter(needs));
    return needs;
}

// What the solver holds.
double memory_mib_of_radiance(const std::array<int, 3>& cells, int degree) {
    constexpr double kFields = 6;
    return kFields * (degree + 1) * (degree + 1) * voxels_of(cells, 1) * sizeof(float) / kMebibyte;
}

// The time of a ray grows with the planes that it passes. The layer is held twice.
Estimate estimate(const Parameters& parameters, const CloudLightBake& asset) {
    constexpr double kSecondsPerPlane = 1e-9;
    constexpr double kRaysPerChannel = 8;
    constexpr double kDirections =
        150;                           // of harmonics, those near the horizon counted several times
    constexpr double kRadiance = 700;  // of radiance, over all sweeps
    const CloudVolumeBake& of = source_volume(parameters, asset.of);
    // Larger cells that do not meet max_error cost twice as much as the one that does, all together.
    const double trials = asset.max_error ? 3 : 1;
    double directions = trials * (config::is_per_sun(asset.contents) ? 2.0 : kDirections);
    if (config::is_radiance(asset.contents)) directions = kRadiance;
    Estimate result =
        estimate_volume(asset, cloud_light_size(of.size, asset), config::channels_of(asset),
                        kRaysPerChannel * kSecondsPerPlane * of.size[2] * directions);
    if (asset.max_error) result.size = {0, 0, 0};
    const Estimate voxels = estimate_cloud_volume(parameters, of);
    result.seconds += voxels.seconds / 2;
    result.memory_mib += voxels.memory_mib + 2 * voxels_of(of.size, 1) * sizeof(float) / kMebibyte;
    if (asset.contents == CloudLightContents::clear_sky_radiance) {
        result.seconds += seconds_to_solve(config::SkyOrders::all);
    }
    if (config::is_radiance(asset.contents)) {
        const auto places =
            cloud_light::place_grid(of.size, cloud_light_spacing(asset), false).count;
        result.memory_mib += memory_mib_of_radiance(places, asset.degree);
    }
    return result;
}

AssetPlaces places(const Parameters& parameters, const CloudLightBake& asset, const StoredTexels&) {
    const Cloud cloud = spanned_cloud(parameters, source_volume(parameters, asset.of));
    if (!is_map(asset)) return cloud_places(cloud, extent_m_of(cloud));
    return single_lookup({"x_m", "y_m", "altitude_m"},
                         [places = cloud_places(cloud, extent_m_of(cloud))](const Place& at) {
                             Probe probe;
                             probe.at = at;
                             Uvw uvw = places.lookups(probe, 0).front().uvw;
                             uvw[2] = 0.5;
                             return uvw;
                         });
}

GlslFunction texels_function(const CloudLightBake& asset, const std::string& box) {
    GlslFunction function;
    function.comment =
        is_map(asset)
            ? "Returns the optical depth of the layer to each sun, seen from x and y in metres at "
              "the layer's base."
            : "Returns the channels at x and y in metres and at the altitude z in metres.";
    function.arguments = "sampler3D light, vec3 p";
    function.before = box;
    function.value = is_map(asset) ? "cloud_shadow(light, p - corner, tile)"
                                   : "cloud_light(light, p - corner, tile)";
    return function;
}

// The part's share of the sum of harmonics; the shares of all parts add up.
GlslFunction harmonics_function(const CloudLightBake& asset, const std::string& box) {
    GlslFunction function;
    function.comment = fmt::format(
        "Returns what these coefficients add to the value in a direction, a unit vector, z up.{}",
        asset.degree > 1 ? " The sums of all parts add up to the value." : "");
    function.result = "float";
    function.arguments = "sampler3D light, vec3 p, vec3 direction";
    function.before = box;
    function.value = fmt::format(
        "dot(cloud_light(light, p - corner, tile), cloud_harmonics_{}(direction))", asset.part);
    if (config::channels_of(asset) == 1) {
        function.value = fmt::format(
            "cloud_light(light, p - corner, tile).r * cloud_harmonics_{}(direction).r", asset.part);
    }
    function.suffix = "_towards";
    return function;
}

AssetLookup lookup(const Parameters& parameters, const CloudLightBake& asset,
                   const StoredTexels& stored) {
    const Cloud cloud = spanned_cloud(parameters, source_volume(parameters, asset.of));
    const std::string box = cloud_box_glsl(cloud);
    AssetLookup lookup = {"cloud_light",
                          {with_channels(stored.channels, 4, texels_function(asset, box))}};
    if (!config::is_per_sun(asset.contents)) {
        lookup.functions.push_back(harmonics_function(asset, box));
    }
    return lookup;
}

void draft(CloudLightBake& asset, int) {
    asset.mips = 1;
    asset.max_error.reset();
}

}  // namespace

Baker<CloudLightBake> baker(BakerTag<CloudLightBake>) {
    return {.version = 14,
            .bake = bake,
            .estimate = estimate,
            .needs = needs,
            .places = places,
            .lookup = lookup,
            .draft = draft,
            .inputs = inputs_of_source<CloudLightBake>,
            .variants = {{"cell"}, {"pixel_type"}}};
}

}  // namespace skybake
