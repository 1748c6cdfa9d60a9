#include "bakers/report/volume_report.h"

#include <fmt/format.h>

#include <utility>
#include <variant>

#include "bakers/assets/registry.h"
#include "bakers/report/sweeps/sweep.h"

namespace skybake {

using config::Outcome;

namespace {

// Writing a compressed file takes ten times as long as making its voxels.
constexpr VolumeRepetitions kVolumeRepetitions = {.voxels = 9, .writes = 3};
constexpr VolumeRepetitions kQuickVolumeRepetitions = {.voxels = 3, .writes = 1};
// As of --certify=quick and --certify=full.
constexpr int kPoints = 16384;
constexpr int kQuickPoints = 1024;

AssetReport describe(const Baked& volume, const VolumeReportSubject& subject, bool quick) {
    const VolumeRepetitions repetitions = quick ? kQuickVolumeRepetitions : kVolumeRepetitions;
    AssetReport report;
    report.name = volume.name;
    report.kind = volume.kind;
    report.reference = volume.certificate.reference;
    report.scale = fmt::format("{}, at {} as baked", volume.certificate.scale,
                               size_text(volume.levels.front().size));
    report.timing =
        subject.timing.empty() ? "processor time of the voxels, one thread" : subject.timing;
    const int points = quick ? kQuickPoints : kPoints;
    report.lookup_points = report.texel_points = subject.points > 0 ? subject.points : points;
    report.repetitions = subject.repetitions > 0 ? subject.repetitions : repetitions.voxels;
    report.volume = VolumeFacts{volume.channel_names, volume.levels.front().statistics,
                                volume.seam_error, repetitions.writes};
    if (volume.levels.front().size != subject.asked_size) {
        report.notes.push_back(
            fmt::format("{}: left out, since it has too many voxels to be measured{}; all figures "
                        "are of smaller volumes",
                        size_text(subject.asked_size), quick ? " quickly" : ""));
    }
    if (subject.asked_mips > 1) {
        report.notes.emplace_back("files hold only the first level of detail");
    }
    return report;
}

}  // namespace

Outcome<AssetReport> report_volume(const config::Recipe& recipe, const VolumeReportSubject& subject,
                                   const ReportOptions& options) {
    Outcome<Baked> baked =
        bake_asset(recipe, subject.bake,
                   BakeOptions{.threads = options.threads, .progress = options.progress});
    if (options.progress != nullptr && options.progress->cancelled()) return {};
    Outcome<AssetReport> outcome;
    outcome.diagnostics = std::move(baked.diagnostics);
    if (!baked.value) return outcome;
    const Baked& volume = *baked.value;
    AssetReport report = describe(volume, subject, options.quick);
    auto measured = measure_volume_sweep(
        subject.sweep, volume, subject.reference, report.lookup_points,
        options.quick ? kQuickVolumeRepetitions : kVolumeRepetitions, options, subject.comparison);
    if (!measured) return {};
    report.rows = std::move(measured->rows);
    report.notes.insert(report.notes.end(), measured->notes.begin(), measured->notes.end());
    outcome.value = std::move(report);
    return outcome;
}

}  // namespace skybake
