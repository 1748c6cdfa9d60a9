// The baker of asset = "cloud_volume".
#include <fmt/format.h>

#include <string>
#include <utility>
#include <vector>

#include "bakers/assets/cloud_volume/cloud_inputs.h"
#include "bakers/assets/cloud_volume/cloud_volume.h"
#include "bakers/assets/cloud_volume/frame_change.h"
#include "bakers/convection/convection.h"
#include "bakers/field/baked.h"
#include "config/sections/cloud.h"
#include "config/sections/parameters.h"

namespace skybake {
namespace {

// Tells how much a frame of a sequence changes until the next one. The first one warns (W0229) of flicker, for all.
void add_change(const CloudVolumeBake& asset, const FrameChange& change, Facts& details,
                std::vector<Diagnostic>& diagnostics) {
    details.emplace_back("flips_per_frame", change.flips);
    details.emplace_back("rms_change_per_frame", change.rms);
    if (asset.frame != 1 || change.flips <= kMostFlips) return;
    diagnostics.push_back(diagnosis(
        "W0229",
        fmt::format(
            "`{}` flickers: {:.0f} % of its voxels become cloud or cease to be until the next frame",
            asset.cloud, 100 * change.flips),
        "give the loop more frames (`period` of the cloud and of its noises)"));
}

Outcome<Baked> bake(const Parameters& parameters, const CloudVolumeBake& asset,
                    const BakeOptions& options, AssetLabel label) {
    Baked volume = labelled_volume(std::move(label));
    const Outcome<CloudInputs> inputs = cloud_inputs(parameters, asset, volume.details, options);
    if (!inputs.value) return {{}, inputs.diagnostics};
    std::vector<Diagnostic> warnings = inputs.diagnostics;
    if (asset.frame > 0) {
        const auto change = change_to_next_frame(parameters, asset, *inputs.value, options);
        if (!change) return {};
        add_change(asset, *change, volume.details, warnings);
    }
    Outcome<Baked> baked = bake_cloud_volume(cloud_named(parameters, asset.cloud), asset,
                                             *inputs.value, options, std::move(volume));
    baked.diagnostics.insert(baked.diagnostics.end(), warnings.begin(), warnings.end());
    return baked;
}

std::vector<Need> needs(const Parameters& parameters, const CloudVolumeBake& asset, Certification) {
    return needs_of_voxels(parameters, asset);
}

AssetPlaces places(const Parameters& parameters, const CloudVolumeBake& asset,
                   const StoredTexels&) {
    const Cloud cloud = spanned_cloud(parameters, asset);
    return cloud_places(cloud, extent_m_of(cloud));
}

AssetLookup lookup(const Parameters& parameters, const CloudVolumeBake& asset,
                   const StoredTexels& stored) {
    const Cloud cloud = spanned_cloud(parameters, asset);
    const bool at_runtime = cloud.threshold_at == config::ThresholdAt::runtime;
    const std::string extinction = fmt::format("Times {} it is extinction in 1/m.",
                                               glsl_number(cloud.extinction_scale.per_meter));
    GlslFunction function;
    function.comment =
        fmt::format("Returns the {} at x and y in metres and at the altitude z in metres.{}",
                    at_runtime ? "value before its threshold" : "density",
                    at_runtime || stored.channels > 1 ? "" : " " + extinction);
    function.arguments = "sampler3D cloud, vec3 p";
    function.before = cloud_box_glsl(cloud);
    function.value = "cloud_texel(cloud, p - corner, tile)";
    AssetLookup lookup = {"clouds", {with_channels(stored.channels, 4, function)}};
    if (at_runtime) {
        function.comment = "Returns the density. " + extinction;
        function.result = "float";
        function.value =
            fmt::format("cloud_edge(cloud_density(cloud, p - corner, tile), {}, {})",
                        glsl_number(cloud.threshold), glsl_number(cloud.edge_softness));
        function.suffix = "_density";
        lookup.functions.push_back(std::move(function));
    }
    return lookup;
}

void draft(CloudVolumeBake& asset, int most_voxels) {
    asset.size = reduced(asset.size, most_voxels);
    asset.mips = 1;
}

}  // namespace

Estimate estimate_cloud_volume(const Parameters& parameters, const CloudVolumeBake& asset) {
    constexpr double kSecondsPerShape = 3e-9;  // profile, threshold, statistics of a voxel
    const Cloud& cloud = cloud_named(parameters, asset.cloud);
    const Noise* base = noise_of(parameters, cloud);
    constexpr double kOctavesOfVolume = 4;  // what reading and resampling take
    double octaves = base != nullptr ? octaves_of(*base) : kOctavesOfVolume;
    if (!cloud.detail.empty()) octaves += octaves_of(noise_named(parameters, cloud.detail));
    Estimate estimate =
        estimate_volume(asset, asset.size, config::cloud_channel_names(base, cloud.channels).size(),
                        octaves * kSecondsPerOctave + kSecondsPerShape);
    estimate.memory_mib += bytes_to_read_maps(cloud) / kMebibyte;
    if (cloud.shape != config::CloudShape::convection) return estimate;
    const convection::Specification wanted = convection::specification_of(cloud);
    estimate.memory_mib += convection::bytes_to_grow(wanted) / kMebibyte;
    return estimate;
}

std::vector<InputFile> cloud_volume_inputs(const Parameters& parameters,
                                           const CloudVolumeBake& asset) {
    const Cloud& cloud = cloud_named(parameters, asset.cloud);
    std::vector<InputFile> files;
    for (const config::CloudMap* map : {&cloud.coverage_map, &cloud.type_map}) {
        if (!map->file.empty()) files.push_back({map->file, map->path});
    }
    if (cloud.volume.empty()) return files;
    const config::VolumeFile& volume = volume_named(parameters, cloud.volume);
    files.push_back({volume.file, volume.path});
    return files;
}

AssetPlaces cloud_places(const Cloud& cloud, const Uvw& extent_m) {
    const Uvw corner_m = corner_m_of(cloud);
    return single_lookup({"x_m", "y_m", "altitude_m"}, [extent_m, corner_m](const Place& at) {
        Uvw uvw;
        for (std::size_t i = 0; i < 3; ++i) uvw[i] = (at[i].second - corner_m[i]) / extent_m[i];
        return uvw;
    });
}

Cloud spanned_cloud(const Parameters& parameters, const CloudVolumeBake& asset) {
    return config::stretched(cloud_named(parameters, asset.cloud), asset);
}

Uvw extent_m_of(const Cloud& cloud) {
    return {cloud.extent[0].meters, cloud.extent[1].meters, cloud.extent[2].meters};
}

Uvw corner_m_of(const Cloud& cloud) {
    return {cloud.corner[0].meters, cloud.corner[1].meters, cloud.base_altitude.meters};
}

std::string cloud_box_glsl(const Cloud& cloud) {
    return fmt::format("    vec3 corner = {}, tile = {};\n", glsl_vector(corner_m_of(cloud)),
                       glsl_vector(extent_m_of(cloud)));
}

GlslFunction march_function(std::string_view cells, const std::string& call, std::string before) {
    return {
        .comment =
            "Returns the sum of densities times metres over `count` samples, all of them within "
            "the layer, at from, from + ray * stride and so on. `cloud` is the volume.",
        .result = "float",
        .arguments = fmt::format(
            "sampler3D cloud, sampler3D {}, vec3 from, vec3 ray, float stride, int count", cells),
        .value = call + ", from - corner, ray, tile, stride, count)",
        .before = std::move(before)};
}

Baker<CloudVolumeBake> baker(BakerTag<CloudVolumeBake>) {
    return {.version = 12,
            .bake = bake,
            .estimate = estimate_cloud_volume,
            .needs = needs,
            .places = places,
            .lookup = lookup,
            .draft = draft,
            .inputs = cloud_volume_inputs,
            .variants = {{"size"}, {"pixel_type"}, {"formats"}}};
}

}  // namespace skybake
