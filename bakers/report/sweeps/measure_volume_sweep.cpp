#include "bakers/report/sweeps/measure_volume_sweep.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <memory>
#include <utility>
#include <vector>

#include "bakers/field/baked.h"
#include "bakers/field/block_voxels.h"
#include "bakers/field/certify.h"
#include "bakers/field/stored_voxels.h"
#include "bakers/field/survey_volume.h"
#include "bakers/field/voxel_array.h"
#include "bakers/io/manifest/asset_files.h"
#include "bakers/math/memory.h"
#include "bakers/report/sweeps/sweep.h"

namespace skybake {

using config::Diagnostic;
using config::FileFormat;
using config::Outcome;
using config::PixelType;
using Voxels = std::shared_ptr<const VoxelSource>;

namespace {

void advance_sweep(const ReportOptions& options, std::string_view step, double fraction) {
    if (options.progress != nullptr) options.progress->advance(step, fraction);
}

constexpr std::array kTypes = {PixelType::float32, PixelType::half, PixelType::unorm16,
                               PixelType::unorm8,  PixelType::bc4,  PixelType::bc6h,
                               PixelType::fp16,    PixelType::fp8};

double milliseconds(double seconds) { return std::round(seconds * 1e9) / 1e6; }  // whole ns

// Voxels that several variants share, because the way of storing does not change them.
struct SharedVoxels {
    const VoxelSource* source;
    std::array<int, 3> size;
    std::optional<double> known_seconds;
    double seconds = 0;
};

std::vector<SharedVoxels> voxels_of(const VolumeSweep& sweep) {
    std::vector<SharedVoxels> all;
    for (const VolumeVariant& variant : sweep.variants) {
        const bool there = std::any_of(all.begin(), all.end(), [&](const SharedVoxels& voxels) {
            return voxels.source == variant.voxels.get();
        });
        if (!there) all.push_back({variant.voxels.get(), variant.size, variant.seconds});
    }
    return all;
}

std::size_t floats_of_box(const SharedVoxels& voxels, std::size_t channels) {
    const BoxSequence boxes(voxels.size, static_cast<int>(channels));
    return static_cast<std::size_t>(boxes.largest_count()) * channels;
}

// Makes all voxels box after box, as writers do, in the same memory again and again.
void make_voxels(const SharedVoxels& voxels, std::size_t channels, AlignedFloats& memory) {
    const BoxSequence boxes(voxels.size, static_cast<int>(channels));
    const auto plane = static_cast<std::size_t>(boxes.largest_count());
    std::vector<float*> planes;
    for (std::size_t c = 0; c < channels; ++c) planes.push_back(memory.data() + c * plane);
    for (int i = 0; i < boxes.count(); ++i) voxels.source->fill(boxes[i], planes);
}

// Measures the time of making the voxels. Returns false after an interruption.
bool time_voxels(std::vector<SharedVoxels>& all, std::size_t channels, int repetitions,
                 const ReportOptions& options) {
    AlignedFloats memory;
    for (const SharedVoxels& voxels : all) {
        memory.resize(std::max(memory.size(), floats_of_box(voxels, channels)));
    }
    std::vector<std::function<void()>> jobs;
    std::vector<SharedVoxels*> timed;
    for (SharedVoxels& voxels : all) {
        voxels.seconds = voxels.known_seconds.value_or(0);
        if (voxels.known_seconds) continue;
        timed.push_back(&voxels);
        jobs.emplace_back([&] { make_voxels(voxels, channels, memory); });
    }
    const double runs = static_cast<double>(jobs.size()) * repetitions;
    const std::vector<double> seconds =
        interleaved_medians(jobs, repetitions, [&](int round, std::size_t job) {
            const std::size_t done = static_cast<std::size_t>(round) * jobs.size() + job;
            advance_sweep(options, "timing", static_cast<double>(done) / runs);
            return !is_cancelled(options.progress);
        });
    for (std::size_t i = 0; i < seconds.size(); ++i) timed[i]->seconds = seconds[i];
    return !seconds.empty() || timed.empty();
}

struct Written {
    std::uint64_t bytes = 0;
    double seconds = 0;
};

// Writes the volume's file to memory. After an interruption there is neither a value nor a
// diagnostic.
Outcome<Written> write_to_memory(const Baked& volume, int repetitions,
                                 const ReportOptions& options) {
    const ManifestAsset asset = describe_with_files(volume);
    Outcome<Written> outcome;
    Written written;
    constexpr int kThreads = 1;  // the thread that is timed
    const auto write = [&] {
        const MemoryFile file;
        outcome.diagnostics =
            write_asset_file(volume, asset, asset.files.front(), kThreads, nullptr, file.path())
                .diagnostics;
        written.bytes = file.bytes();
    };
    const std::vector<double> seconds =
        interleaved_medians({write}, repetitions, [&](int, std::size_t) {
            return outcome.diagnostics.empty() && !is_cancelled(options.progress);
        });
    if (seconds.empty()) return outcome;
    written.seconds = seconds.front();
    if (outcome.diagnostics.empty()) outcome.value = written;
    return outcome;
}

class VolumeMeasurement {
  public:
    VolumeMeasurement(const VolumeSweep& sweep, const Baked& baked,
                      const ReferenceOfSize& reference, const ComparisonOfSize& comparison,
                      int points, int write_repetitions, const ReportOptions& options)
        : sweep_(sweep),
          baked_(baked),
          points_(points),
          write_repetitions_(write_repetitions),
          options_(options),
          reference_(reference),
          comparison_(comparison),
          rows_(sweep.variants.size()) {
        notes_ = sweep.notes;
        for (const ValueStatistics& channel : baked.levels.front().statistics) {
            histogram_ranges_.push_back(channel.histogram_range);
        }
    }

    // Measures all variants with these voxels. Returns false after an interruption.
    bool measure(const SharedVoxels& voxels) {
        const auto stored = std::make_shared<VoxelArray>(
            read_voxels(*voxels.source, voxels.size, static_cast<int>(baked_.channel_names.size()),
                        BakeOptions{.threads = options_.threads}, "voxels"));
        for (const PixelType type : kTypes) {
            std::vector<std::size_t> variants;
            for (std::size_t i = 0; i < sweep_.variants.size(); ++i) {
                const VolumeVariant& variant = sweep_.variants[i];
                const bool is_such =
                    variant.voxels.get() == voxels.source && variant.pixel_type == type;
                if (is_such) variants.push_back(i);
            }
            if (!variants.empty() && !measure_stored(voxels, stored, type, variants)) return false;
        }
        return true;
    }

    MeasuredSweep result() {
        MeasuredSweep measured;
        for (std::optional<ReportRow>& row : rows_) {
            if (row) measured.rows.push_back(std::move(*row));
        }
        measured.notes = std::move(notes_);
        return measured;
    }

  private:
    void leave_out(const VolumeVariant& variant, const Diagnostic& reason) {
        notes_.push_back(
            fmt::format("{}, {}: left out, {}", variant.family, variant.name, reason.message));
    }

    // Measures variants that hold the same values in different files. Returns false after an
    // interruption.
    bool measure_stored(const SharedVoxels& voxels, const Voxels& stored, PixelType type,
                        const std::vector<std::size_t>& variants) {
        Baked volume = baked_;
        volume.pixel_type = type;
        volume.levels.resize(1);
        Level& level = volume.levels.front();
        level.size = voxels.size;
        level.voxels = stored;
        level.uncoded = nullptr;
        code_levels(volume);
        if (is_cancelled(options_.progress)) return false;
        const BakeOptions quiet{.threads = options_.threads};
        const std::vector<Diagnostic> problems = survey_level(volume, 0, histogram_ranges_, quiet);
        if (!problems.empty()) {
            for (const std::size_t i : variants) leave_out(sweep_.variants[i], problems.front());
            return true;
        }
        ReportRow row;
        row.asset = baked_.name;
        row.size.assign(voxels.size.begin(), voxels.size.end());
        row.pixel_type = type;
        row.time_ms = milliseconds(voxels.seconds);
        measure_errors(level, type, sweep_.variants[variants.front()], row);
        for (const std::size_t i : variants) {
            if (!measure_file(sweep_.variants[i], volume, row, rows_[i])) return false;
        }
        return true;
    }

    void measure_errors(const Level& level, PixelType type, const VolumeVariant& variant,
                        ReportRow& row) const {
        const BakeOptions quiet{.threads = options_.threads};
        if (variant.measure) {
            const Certificate measured = variant.measure(type, points_, quiet);
            row.texel = measured.texel;
            row.lookup = measured.lookup;
            return;
        }
        Level scaled = level;
        scaled.statistics = baked_.levels.front().statistics;
        const VolumeReference reference = reference_(level.size);
        const VolumeComparison comparison =
            comparison_ ? comparison_(level.size) : VolumeComparison{};
        const auto centres =
            static_cast<int>(std::min<std::int64_t>(points_, VoxelBox{{}, level.size}.count()));
        row.texel = measure_voxels(scaled, type, reference, centres, quiet, comparison).figures;
        row.lookup = measure_lookups(scaled, type, reference, points_, quiet, comparison).figures;
    }

    // Measures a file. `result` stays empty if the file cannot be made. Returns false after an
    // interruption.
    bool measure_file(const VolumeVariant& variant, Baked& volume, const ReportRow& values,
                      std::optional<ReportRow>& result) {
        volume.formats = {variant.format};
        volume.compression = variant.compression;
        volume.vdb_compression = variant.vdb_compression;
        const Outcome<Written> written = write_to_memory(volume, write_repetitions_, options_);
        if (!written.diagnostics.empty()) leave_out(variant, written.diagnostics.front());
        advance_sweep(options_, "files",
                      static_cast<double>(++done_) / static_cast<double>(rows_.size()));
        if (!written.value) return !written.diagnostics.empty();
        ReportRow row = values;
        row.family = variant.family;
        row.variant = variant.name;
        row.baseline = variant.baseline;
        row.of_recipe = variant.of_recipe;
        row.in_quadrature_sweep = variant.in_quadrature_sweep;
        row.file_bytes = written.value->bytes;
        row.volume_file =
            VolumeFile{variant.format, describe_with_files(volume).files.front().compression,
                       milliseconds(written.value->seconds)};
        result = std::move(row);
        return true;
    }

    const VolumeSweep& sweep_;
    const Baked& baked_;
    const int points_;
    const int write_repetitions_;
    const ReportOptions& options_;
    const ReferenceOfSize& reference_;
    const ComparisonOfSize& comparison_;
    std::vector<std::array<double, 2>> histogram_ranges_;
    std::vector<std::optional<ReportRow>> rows_;  // in the order of the sweep
    std::vector<std::string> notes_;
    std::size_t done_ = 0;
};

// Rounds an error to two digits, which more points would not change. If two pixel types are much
// finer than the interpolation error, their lookup errors then compare as equal.
double two_digits(double rms) {
    if (!(rms > 0) || !std::isfinite(rms)) return rms;
    const double unit = std::pow(10.0, std::floor(std::log10(rms)) - 1);
    return std::round(rms / unit) * unit;
}

void mark_bytes_front(std::vector<ReportRow>& rows) {
    mark_front(
        rows, [](const ReportRow&) { return true; },
        [](const ReportRow& row) {
            return CostAndError{static_cast<double>(row.file_bytes), two_digits(row.lookup.rms)};
        },
        0, [](ReportRow& row) { row.volume_file->on_bytes_front = true; });
}

}  // namespace

RememberedReference::RememberedReference(VolumeReference definition)
    : definition_(std::move(definition)) {}

std::vector<double> RememberedReference::operator()(const std::array<double, 3>& place) {
    {
        const std::lock_guard lock(mutex_);
        const auto known = values_.find(place);
        if (known != values_.end()) return known->second;
    }
    std::vector<double> value = definition_(place);
    const std::lock_guard lock(mutex_);
    return values_.emplace(place, std::move(value)).first->second;
}

std::optional<MeasuredSweep> measure_volume_sweep(const VolumeSweep& sweep, const Baked& baked,
                                                  const ReferenceOfSize& reference, int points,
                                                  const VolumeRepetitions& repetitions,
                                                  const ReportOptions& options,
                                                  const ComparisonOfSize& comparison) {
    std::vector<SharedVoxels> all = voxels_of(sweep);
    if (!time_voxels(all, baked.channel_names.size(), repetitions.voxels, options)) {
        return std::nullopt;
    }
    VolumeMeasurement measurement(sweep, baked, reference, comparison, points, repetitions.writes,
                                  options);
    for (const SharedVoxels& voxels : all) {
        if (!measurement.measure(voxels)) return std::nullopt;
    }
    if (is_cancelled(options.progress)) return std::nullopt;
    MeasuredSweep measured = measurement.result();
    mark_time_fronts(measured.rows, two_digits);
    mark_bytes_front(measured.rows);
    return measured;
}

}  // namespace skybake
