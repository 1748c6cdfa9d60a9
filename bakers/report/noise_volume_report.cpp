#include "bakers/report/noise_volume_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <utility>
#include <variant>

#include "bakers/registry.h"
#include "bakers/report/measure_volume_sweep.h"
#include "bakers/report/noise_volume_sweep.h"
#include "bakers/report/sweep.h"

namespace skybake {

using config::Noise;
using config::NoiseVolumeBake;
using config::Outcome;

namespace {

// Writing a compressed file takes ten times as long as making its voxels.
constexpr VolumeRepetitions kRepetitions = {.voxels = 9, .writes = 3};
constexpr VolumeRepetitions kQuickRepetitions = {.voxels = 3, .writes = 1};
// As of --certify=quick and --certify=full.
constexpr int kPoints = 16384;
constexpr int kQuickPoints = 1024;

const Noise& noise_of(const config::Parameters& parameters, const std::string& name) {
    return *std::find_if(parameters.noises.begin(), parameters.noises.end(),
                         [&](const Noise& noise) { return noise.name == name; });
}

AssetReport describe(const BakedVolume& volume, const NoiseVolumeBake& asked, bool quick) {
    const VolumeRepetitions repetitions = quick ? kQuickRepetitions : kRepetitions;
    AssetReport report;
    report.name = volume.name;
    report.kind = volume.kind;
    report.reference = volume.certificate.reference;
    report.scale = fmt::format("{}, at {} as baked", volume.certificate.scale,
                               size_text(volume.levels.front().size));
    report.timing = "processor time of the voxels, one thread";
    report.lookup_points = report.texel_points = quick ? kQuickPoints : kPoints;
    report.repetitions = repetitions.voxels;
    report.volume = VolumeFacts{volume.channel_names, volume.levels.front().statistics,
                                volume.seam_error, repetitions.writes};
    if (volume.levels.front().size != asked.size) {
        report.notes.push_back(fmt::format(
            "{}: left out, too many voxels to be measured{}; all figures are of smaller volumes",
            size_text(asked.size), quick ? " quickly" : ""));
    }
    if (asked.mips > 1) report.notes.emplace_back("files are those of the first level of detail");
    return report;
}

}  // namespace

Outcome<AssetReport> report_noise_volume(const config::Recipe& recipe, const config::Bake& bake,
                                         const ReportOptions& options) {
    config::Bake subject = bake;
    auto& asset = std::get<NoiseVolumeBake>(subject.asset);
    const NoiseVolumeBake asked = asset;
    const Noise& noise = noise_of(recipe.parameters, asset.noise);
    asset.size = report_size(noise, asset, options.quick);
    asset.mips = 1;
    Outcome<BakedAsset> baked = bake_asset(
        recipe, subject, BakeOptions{.threads = options.threads, .progress = options.progress});
    if (options.progress != nullptr && options.progress->cancelled()) return {};
    Outcome<AssetReport> outcome;
    outcome.diagnostics = std::move(baked.diagnostics);
    if (!baked.value) return outcome;
    const auto& volume = std::get<BakedVolume>(*baked.value);
    AssetReport report = describe(volume, asked, options.quick);
    const VolumeSweep sweep = noise_volume_sweep(noise, asked, asset.size, options.quick);
    auto measured = measure_volume_sweep(sweep, volume, noise, report.lookup_points,
                                         options.quick ? kQuickRepetitions : kRepetitions, options);
    if (!measured) return {};
    report.rows = std::move(measured->rows);
    report.notes.insert(report.notes.end(), measured->notes.begin(), measured->notes.end());
    outcome.value = std::move(report);
    return outcome;
}

}  // namespace skybake
