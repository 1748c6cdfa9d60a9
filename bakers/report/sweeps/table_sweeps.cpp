#include "bakers/report/sweeps/table_sweeps.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "bakers/field/baked.h"
#include "bakers/field/survey_volume.h"
#include "bakers/io/manifest/asset_files.h"
#include "bakers/report/sweeps/sweep.h"

namespace skybake {

namespace {

// Texels that several variants share, because the pixel type does not change them.
struct Texels {
    const TableModel* model;
    int level;
    std::array<int, 2> size;
    Image2<double> image;
    double seconds = 0;
};

bool makes(const Texels& texels, const Variant& variant) {
    return texels.model == variant.model.get() && texels.level == variant.level &&
           texels.size == variant.size;
}

std::vector<Texels> texels_of(const Sweep& sweep) {
    std::vector<Texels> all;
    for (const Variant& variant : sweep.variants) {
        const bool there = std::any_of(
            all.begin(), all.end(), [&](const Texels& texels) { return makes(texels, variant); });
        if (!there) all.push_back({variant.model.get(), variant.level, variant.size, {}});
    }
    return all;
}

void advance(const ReportOptions& options, std::string_view step, double fraction) {
    if (options.progress != nullptr) options.progress->advance(step, fraction);
}

// Makes and times all texels. Returns false after an interruption.
bool make_texels(std::vector<Texels>& all, int repetitions, const ReportOptions& options) {
    std::vector<std::function<void()>> jobs;
    for (Texels& texels : all) {
        jobs.emplace_back([&texels] {
            texels.image =
                bake_texels(*texels.model, texels.level, texels.size, BakeOptions{.threads = 1});
        });
    }
    const double runs = static_cast<double>(jobs.size()) * repetitions;
    const std::vector<double> seconds =
        interleaved_medians(jobs, repetitions, [&](int round, std::size_t job) {
            const std::size_t done = static_cast<std::size_t>(round) * jobs.size() + job;
            advance(options, "timing", static_cast<double>(done) / runs);
            return !is_cancelled(options.progress);
        });
    for (std::size_t i = 0; i < seconds.size(); ++i) all[i].seconds = seconds[i];
    return !seconds.empty() || all.empty();
}

// A memo of the references of a sweep's models. Each is calculated when it is first needed.
class References {
  public:
    References(const Sweep& sweep, const ReportOptions& options)
        : sweep_(sweep), options_{.threads = options.threads, .progress = options.progress} {}

    const ReferencePoints& lookups(const TableModel& truth) {
        const auto [at, fresh] = lookups_.try_emplace(&truth);
        if (fresh) at->second = reference_points(truth, sweep_.lookups, options_);
        return at->second;
    }

    const ReferencePoints& texels(const TableModel& truth, std::array<int, 2> size) {
        const auto [at, fresh] = texels_.try_emplace({&truth, size});
        if (fresh) at->second = reference_texels(truth, size, sweep_.texels, options_);
        return at->second;
    }

  private:
    const Sweep& sweep_;
    BakeOptions options_;
    std::map<const TableModel*, ReferencePoints> lookups_;
    std::map<std::pair<const TableModel*, std::array<int, 2>>, ReferencePoints> texels_;
};

ReportRow describe(const Variant& variant, const Baked& baked) {
    ReportRow row;
    row.asset = baked.name;
    row.family = variant.family;
    row.variant = variant.name;
    row.baseline = variant.baseline;
    row.of_recipe = variant.of_recipe;
    row.in_quadrature_sweep = variant.in_quadrature_sweep;
    row.size.assign(variant.size.begin(), variant.size.end());
    row.pixel_type = variant.pixel_type;
    return row;
}

Baked stored_as(const Variant& variant, const Image2<double>& texels, const Baked& baked) {
    Baked table = baked;
    table.formats = {config::FileFormat::exr};
    table.mips = 1;
    table.pixel_type = variant.pixel_type;
    table.range = {};
    set_image(store_texels(texels, variant.pixel_type, table.range), table);
    return table;
}

// Returns the number of bytes of the table's file. E0401 or E0402 if the pixel type cannot hold the
// texels.
config::Outcome<std::uint64_t> file_bytes(Baked& table) {
    const std::vector<std::array<double, 2>> ranges(table.channel_names.size(), {0.0, 1.0});
    auto problems = survey_level(table, 0, ranges, BakeOptions{.threads = 1});
    if (!problems.empty()) return {{}, std::move(problems)};
    const ManifestAsset asset = describe_with_files(table);
    const MemoryFile file;
    auto written = write_asset_file(table, asset, asset.files.front(), 1, nullptr, file.path());
    if (!written.value) return {{}, std::move(written.diagnostics)};
    return {file.bytes(), {}};
}

}  // namespace

std::optional<MeasuredSweep> measure_sweep(const Sweep& sweep, const Baked& baked, int repetitions,
                                           const ReportOptions& options) {
    std::vector<Texels> all_texels = texels_of(sweep);
    if (!make_texels(all_texels, repetitions, options)) return std::nullopt;

    MeasuredSweep measured;
    References references(sweep, options);
    for (const Variant& variant : sweep.variants) {
        if (is_cancelled(options.progress)) return std::nullopt;
        const Texels& texels =
            *std::find_if(all_texels.begin(), all_texels.end(),
                          [&](const Texels& candidate) { return makes(candidate, variant); });
        ReportRow row = describe(variant, baked);
        row.time_ms = std::round(texels.seconds * 1e9) / 1e6;  // the clock counts nanoseconds
        Baked table = stored_as(variant, texels.image, baked);
        const config::Outcome<std::uint64_t> bytes = file_bytes(table);
        if (!bytes.value) {
            measured.notes.push_back(variant.family + ", " + variant.name + ": left out, " +
                                     bytes.diagnostics.front().message);
            continue;
        }
        row.file_bytes = *bytes.value;
        const ReferencePoints& lookups = references.lookups(*variant.truth);
        const ReferencePoints& centres = references.texels(*variant.truth, variant.size);
        if (is_cancelled(options.progress)) return std::nullopt;
        row.lookup = measure_lookups(*variant.truth, table.image(), lookups).figures;
        row.texel = measure_lookups(*variant.truth, table.image(), centres).figures;
        measured.rows.push_back(std::move(row));
    }
    mark_time_fronts(measured.rows, [](double rms) { return rms; });
    return measured;
}

}  // namespace skybake
