#include "bakers/assets/cloud_volume/cloud_inputs.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <utility>

#include "bakers/assets/description/estimate.h"
#include "bakers/clouds/cover_search.h"
#include "bakers/clouds/grown_volume.h"
#include "bakers/io/formats/png/map_image.h"
#include "bakers/io/volumes/volume_reader.h"
#include "config/diagnostics/diagnostic_codes.h"

namespace skybake {
namespace {

// None where the cloud names no map, and after an error.
std::optional<cloud::MapLookup> read_map(const config::CloudMap& map, const char* key,
                                         Facts& details, std::vector<Diagnostic>& diagnostics) {
    if (map.file.empty()) return std::nullopt;
    Outcome<MapImage> image = read_map_image(map);
    for (Diagnostic& diagnostic : image.diagnostics) diagnostics.push_back(std::move(diagnostic));
    if (!image.value) return std::nullopt;
    details.emplace_back(fmt::format("{}_hash", key), image.value->content_hash);
    return cloud::MapLookup(std::move(*image.value), map.wrap, map.filter);
}

// Adds what a reader of the files needs to know of where the voxels come from. None after an error.
std::optional<cloud::CloudVolume> read_volume(const config::VolumeFile& file, Facts& details,
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

// Returns what has grown. Null after an interruption.
std::shared_ptr<const convection::GrownCloud> grown_cloud(const Cloud& cloud, Facts& details,
                                                          const BakeOptions& options) {
    const convection::Specification wanted = convection::specification_of(cloud);
    Intermediates* shared = options.intermediates;
    const auto grown = shared_or_made<convection::GrownCloud>(shared, NeedKey(wanted), [&] {
        return convection::grow(wanted, options, shared ? shared->kept() : nullptr);
    });
    if (!grown) return nullptr;
    details.emplace_back("full_water_g_per_kg", double{grown->full_water});
    return convection::at_share(grown, double{1} * cloud.time / std::max(cloud.period, 1));
}

CloudInputs with_grown_volume(CloudInputs inputs, const Cloud& cloud,
                              const std::array<int, 3>& size, double coverage) {
    inputs.volume = cloud::volume_of_grown(inputs.grown, cloud, inputs.detail, size, coverage);
    return inputs;
}

// Returns null after an interruption.
std::shared_ptr<const cloud::FoundCover> found_cover(const Parameters& parameters,
                                                     const CloudVolumeBake& bake,
                                                     const CloudInputs& inputs,
                                                     const BakeOptions& options) {
    const Cloud& cloud = cloud_named(parameters, bake.cloud);
    return shared_or_made<cloud::FoundCover>(
        options.intermediates, key_of_coverage(parameters, bake),
        [&]() -> std::shared_ptr<const cloud::FoundCover> {
            const cloud::CoverRequest request = {*bake.cover, filtered_threshold(cloud),
                                                 bake.pixel_type};
            const auto plan_of = [&](double coverage) {
                return plan_of_cloud(cloud, with_grown_volume(inputs, cloud, bake.size, coverage),
                                     bake.size);
            };
            const cloud::FoundCover found =
                inputs.grown
                    ? cloud::find_grown_cover(plan_of, bake.size, request, options)
                    : cloud::find_cover(plan_of_cloud(cloud, inputs, bake.size), request, options);
            return options.cancelled() ? nullptr : std::make_shared<cloud::FoundCover>(found);
        });
}

// Returns E0412 if the share of columns differs from the wanted one by more than a column's, and by
// more than what ties of columns excuse.
std::optional<Diagnostic> missed_cover(const CloudVolumeBake& bake,
                                       const cloud::FoundCover& found) {
    const double columns = double{1} * bake.size[0] * bake.size[1];
    const double most = std::max(1 / columns, 1.0 / cloud::kMostTiedColumns);
    if (std::fabs(found.share - *bake.cover) <= most) return std::nullopt;
    std::string message = fmt::format(
        "cloud `{}` cannot cover {:.4g} %: at coverage {:.6g} it covers {:.4g} %, and more at once",
        bake.cloud, 100 * *bake.cover, found.coverage, 100 * found.share);
    if (found.share == found.reach[0] || found.share == found.reach[1]) {
        message = fmt::format(
            "cloud `{}` cannot cover {:.4g} %: it covers {:.4g} % at coverage {:g}, and "
            "{:.4g} % at coverage {:g}",
            bake.cloud, 100 * *bake.cover, 100 * found.reach[0], found.tried[0],
            100 * found.reach[1], found.tried[1]);
    }
    return diagnosis("E0412", std::move(message),
                     "`cover` cannot be reached; change it or the shape of the cloud", "cover");
}

}  // namespace

bool take_shape(const Parameters& parameters, const CloudVolumeBake& bake, CloudInputs& inputs,
                Facts& details, const BakeOptions& options) {
    const Cloud& cloud = cloud_named(parameters, bake.cloud);
    inputs.base = noise_of(parameters, cloud);
    if (!cloud.detail.empty()) inputs.detail = &noise_named(parameters, cloud.detail);
    if (cloud.shape != config::CloudShape::convection) return true;
    inputs.grown = grown_cloud(cloud, details, options);
    if (!inputs.grown) return false;
    const double coverage = inputs.coverage.value_or(cloud.coverage);
    inputs = with_grown_volume(std::move(inputs), cloud, bake.size, coverage);
    return true;
}

Outcome<CloudInputs> cloud_inputs(const Parameters& parameters, const CloudVolumeBake& bake,
                                  Facts& details, const BakeOptions& options) {
    Outcome<CloudInputs> outcome;
    const Cloud& cloud = cloud_named(parameters, bake.cloud);
    CloudInputs inputs;
    if (!take_shape(parameters, bake, inputs, details, options)) return {};
    if (inputs.base == nullptr && !inputs.volume) {
        inputs.file = &volume_named(parameters, cloud.volume);
        inputs.volume =
            read_volume(*inputs.file, details, options.intermediates, outcome.diagnostics);
    }
    inputs.maps.coverage =
        read_map(cloud.coverage_map, "coverage_map", details, outcome.diagnostics);
    inputs.maps.type = read_map(cloud.type_map, "type_map", details, outcome.diagnostics);
    if (config::exit_code(outcome.diagnostics) == 0 && bake.cover) {
        const auto found = found_cover(parameters, bake, inputs, options);
        if (!found) return {};
        inputs.coverage = found->coverage;
        if (inputs.grown) {
            inputs = with_grown_volume(std::move(inputs), cloud, bake.size, found->coverage);
        }
        details.emplace_back("coverage", found->coverage);
        if (auto problem = missed_cover(bake, *found)) {
            outcome.diagnostics.push_back(std::move(*problem));
        }
    }
    if (config::exit_code(outcome.diagnostics) == 0) outcome.value = std::move(inputs);
    return outcome;
}

double bytes_to_read_maps(const Cloud& cloud) {
    constexpr double kLibrary = 48 * kMebibyte;  // OpenImageIO, measured and rounded up
    constexpr double kPerPixel = 13;
    const double pixels = map_pixels(cloud.coverage_map) + map_pixels(cloud.type_map);
    return pixels > 0 ? kLibrary + kPerPixel * pixels : 0;
}

std::vector<Diagnostic> check_cloud_files(const Parameters& parameters) {
    std::vector<Diagnostic> problems;
    for (const Cloud& cloud : parameters.clouds) {
        for (const config::CloudMap* map : {&cloud.coverage_map, &cloud.type_map}) {
            if (map->file.empty()) continue;
            const Outcome<MapImage> image = read_map_image(*map);
            problems.insert(problems.end(), image.diagnostics.begin(), image.diagnostics.end());
        }
    }
    for (const config::VolumeFile& volume : parameters.volumes) {
        const Outcome<SourceVoxels> source = open_volume(volume);
        problems.insert(problems.end(), source.diagnostics.begin(), source.diagnostics.end());
    }
    return problems;
}

}  // namespace skybake
