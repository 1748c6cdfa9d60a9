#include "bakers/assets/cloud_volume/cloud_inputs.h"

#include <fmt/format.h>

#include <optional>

#include "bakers/io/formats/png/map_image.h"
#include "config/assets/cloud_volume.h"
#include "config/sections/parameters.h"

namespace skybake {

namespace {

using config::CloudMap;
using config::Diagnostic;
using config::Outcome;

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

}  // namespace

Outcome<CloudInputs> cloud_inputs(const config::Parameters& parameters,
                                  const config::CloudVolumeBake& bake, Facts& details) {
    Outcome<CloudInputs> outcome;
    const config::Cloud& cloud = cloud_named(parameters, bake.cloud);
    CloudInputs inputs;
    inputs.base = &noise_named(parameters, cloud.noise);
    if (!cloud.detail.empty()) inputs.detail = &noise_named(parameters, cloud.detail);
    inputs.maps.coverage =
        read_map(cloud.coverage_map, "coverage_map", details, outcome.diagnostics);
    inputs.maps.type = read_map(cloud.type_map, "type_map", details, outcome.diagnostics);
    if (outcome.diagnostics.empty()) outcome.value = std::move(inputs);
    return outcome;
}

std::vector<Diagnostic> check_maps(const config::Parameters& parameters) {
    std::vector<Diagnostic> problems;
    for (const config::Cloud& cloud : parameters.clouds) {
        for (const CloudMap* map : {&cloud.coverage_map, &cloud.type_map}) {
            if (map->file.empty()) continue;
            const Outcome<MapImage> image = read_map_image(*map);
            problems.insert(problems.end(), image.diagnostics.begin(), image.diagnostics.end());
        }
    }
    return problems;
}

}  // namespace skybake
