#include "bakers/assets/cloud_volume/cloud_inputs.h"

#include <fmt/format.h>

#include <memory>
#include <optional>
#include <utility>

#include "bakers/io/formats/png/map_image.h"
#include "bakers/io/volumes/volume_reader.h"
#include "config/assets/cloud_volume.h"
#include "config/sections/parameters.h"

namespace skybake {

namespace {

using config::CloudMap;
using config::Diagnostic;
using config::Outcome;
using config::VolumeFile;

// None where the cloud names no map, and after an error.
std::optional<cloud::MapLookup> read_map(const CloudMap& map, const char* key, Facts& details,
                                         std::vector<Diagnostic>& diagnostics) {
    if (map.file.empty()) return std::nullopt;
    Outcome<MapImage> image = read_map_image(map);
    for (Diagnostic& diagnostic : image.diagnostics) diagnostics.push_back(std::move(diagnostic));
    if (!image.value) return std::nullopt;
    details.emplace_back(fmt::format("{}_hash", key), image.value->content_hash);
    return cloud::MapLookup(std::move(*image.value), map.wrap, map.filter);
}

// Adds what a reader of the files needs to know of where the voxels come from. None after an error.
std::optional<cloud::CloudVolume> read_volume(const VolumeFile& file, Facts& details,
                                              Intermediates* shared,
                                              std::vector<Diagnostic>& diagnostics) {
    const auto source = shared_or_made<SourceVoxels>(
        shared, NeedKey(file), [&]() -> std::shared_ptr<const SourceVoxels> {
            Outcome<SourceVoxels> opened = open_volume(file);
            for (Diagnostic& problem : opened.diagnostics) {
                diagnostics.push_back(std::move(problem));
            }
            if (!opened.value) return nullptr;
            return std::make_shared<const SourceVoxels>(std::move(*opened.value));
        });
    if (!source) return std::nullopt;
    const auto& [x, y, z] = source->size;
    const auto& edges = source->voxel_size_m;
    details.emplace_back("volume_voxels", fmt::format("{} x {} x {}", x, y, z));
    details.emplace_back("volume_voxel_size",
                         fmt::format("{} x {} x {} m", edges[0], edges[1], edges[2]));
    const bool repeats = file.wrap == config::VolumeWrap::repeat;
    details.emplace_back("volume_wrap", repeats ? "repeat" : "empty");
    details.emplace_back("volume_border", static_cast<double>(file.border));
    return cloud::CloudVolume{*source, file.wrap};
}

}  // namespace

Outcome<CloudInputs> cloud_inputs(const config::Parameters& parameters,
                                  const config::CloudVolumeBake& bake, Facts& details,
                                  Intermediates* shared) {
    Outcome<CloudInputs> outcome;
    const config::Cloud& cloud = cloud_named(parameters, bake.cloud);
    CloudInputs inputs;
    inputs.base = noise_of(parameters, cloud);
    if (inputs.base == nullptr) {
        inputs.file = &volume_named(parameters, cloud.volume);
        inputs.volume = read_volume(*inputs.file, details, shared, outcome.diagnostics);
    }
    if (!cloud.detail.empty()) inputs.detail = &noise_named(parameters, cloud.detail);
    inputs.maps.coverage =
        read_map(cloud.coverage_map, "coverage_map", details, outcome.diagnostics);
    inputs.maps.type = read_map(cloud.type_map, "type_map", details, outcome.diagnostics);
    if (outcome.diagnostics.empty()) outcome.value = std::move(inputs);
    return outcome;
}

}  // namespace skybake
