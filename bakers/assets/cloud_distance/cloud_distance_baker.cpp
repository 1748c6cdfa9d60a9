// The baker of asset = "cloud_distance".
#include <fmt/format.h>

#include <array>
#include <string>
#include <utility>

#include "bakers/assets/cloud_distance/cloud_distance.h"
#include "bakers/assets/cloud_volume/cloud_volume.h"
#include "bakers/assets/registry/baker.h"
#include "bakers/assets/sources/source_volume.h"
#include "bakers/field/baked.h"
#include "bakers/occupancy/cell_grid.h"
#include "config/assets/cloud_distance.h"
#include "config/assets/cloud_volume.h"
#include "config/sections/parameters.h"

namespace skybake {
namespace {

using config::CloudDistanceBake;
using occupancy::CellGrid;

Outcome<Baked> bake(const Parameters& parameters, const CloudDistanceBake& asset,
                    const BakeOptions& options, AssetLabel label) {
    const CloudVolumeBake& of = source_volume(parameters, asset.of);
    const Cloud& cloud = cloud_named(parameters, of.cloud);
    Baked volume = labelled_volume(std::move(label));
    const Outcome<Baked> held = hold_source_volume(parameters, asset.of, options, volume.details);
    if (!held.value) return {{}, held.diagnostics};
    const Baked& voxels = *held.value;
    const double wisp_height = cloud.detail.empty() ? kUsualWispHeight : cloud.wisp_height;
    return bake_cloud_distance({voxels, filtered_threshold(cloud)}, asset, wisp_height, options,
                               std::move(volume));
}

Estimate estimate(const Parameters& parameters, const CloudDistanceBake& asset) {
    constexpr double kSecondsPerVoxel = 2e-9;
    constexpr double kSecondsPerTexel = 1e-8;
    const CloudVolumeBake& of = source_volume(parameters, asset.of);
    const std::array<int, 3> texels = CellGrid{of.size, asset.cell}.size();
    Estimate result = estimate_volume(asset, texels, asset.contents.size(), kSecondsPerTexel);
    const Estimate voxels = estimate_cloud_volume(parameters, of);
    // Bits of voxels, a float for each column of texels at each height of a voxel, and for each texel
    // those of distance, depth and density.
    const double bytes = voxels_of(of.size, 1) / 8 +
                         sizeof(float) * (voxels_of({texels[0], texels[1], of.size[2] + 1}, 1) +
                                          3 * voxels_of(texels, 1));
    result.seconds += voxels.seconds / 2 + kSecondsPerVoxel * voxels_of(of.size, 1);
    result.memory_mib += voxels.memory_mib + bytes / kMebibyte;
    return result;
}

AssetPlaces places(const Parameters& parameters, const CloudDistanceBake& asset,
                   const StoredTexels&) {
    const CloudVolumeBake& of = source_volume(parameters, asset.of);
    const Cloud cloud = spanned_cloud(parameters, of);
    return cloud_places(cloud, spanned_m({of.size, asset.cell}, cloud));
}

GlslFunction distance_function(const std::string& ends, const std::string& box) {
    return {.comment =
                "Returns how far it is from p, which lies within the layer, to the cloud, in "
                "metres, negative within it: never farther from 0 than it is.",
            .result = "float",
            .arguments = "sampler3D distances, vec3 p",
            .value = fmt::format("cloud_distance(distances, {}, p - corner, box)", ends),
            .before = box,
            .suffix = "_distance"};
}

AssetLookup lookup(const Parameters& parameters, const CloudDistanceBake& asset,
                   const StoredTexels& stored) {
    const CloudVolumeBake& of = source_volume(parameters, asset.of);
    const Cloud cloud = spanned_cloud(parameters, of);
    const Uvw spanned = spanned_m({of.size, asset.cell}, cloud);
    const std::string corner = glsl_vector(corner_m_of(cloud));
    const std::string box =
        fmt::format("    vec3 corner = {}, box = {};\n", corner, glsl_vector(spanned));
    const std::array<double, 2> metres =
        distance_code(asset, config::voxel_edges(cloud, of)).ends();
    const std::string ends =
        fmt::format("vec2({}, {})", glsl_number(metres[0]), glsl_number(metres[1]));
    GlslFunction function;
    function.comment =
        "Returns the channels of the texels at x and y in metres and at the altitude z in metres.";
    function.arguments = "sampler3D distances, vec3 p";
    function.before = box;
    function.value = "cloud_texel(distances, p - corner, box)";
    AssetLookup lookup = {"clouds", {with_channels(stored.channels, 4, std::move(function))}};
    lookup.functions.push_back(distance_function(ends, box));
    if (is_marched_as_stored(cloud)) {
        const std::string tile =
            fmt::format("    vec3 tile = {};\n", glsl_vector(extent_m_of(cloud)));
        lookup.functions.push_back(march_function(
            "distances", fmt::format("cloud_trace(cloud, distances, {}, box", ends), box + tile));
        lookup.functions.back().suffix = "_trace";
    }
    return lookup;
}

// The volume of a draft has fewer voxels, which a larger cell may not divide.
void draft(CloudDistanceBake& asset, int) { asset.cell = 1; }

}  // namespace

Baker<CloudDistanceBake> baker(BakerTag<CloudDistanceBake>) {
    return {.version = 5,
            .bake = bake,
            .estimate = estimate,
            .needs = needs_of_source<CloudDistanceBake>,
            .places = places,
            .lookup = lookup,
            .draft = draft,
            .inputs = inputs_of_source<CloudDistanceBake>};
}

}  // namespace skybake
