#include "bakers/report/report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "bakers/assets/registry/registry.h"
#include "bakers/assets/sky/traced_light.h"
#include "bakers/field/baked.h"
#include "bakers/io/manifest/asset_files.h"
#include "bakers/math/intermediates.h"
#include "config/assets/asset_kind.h"

namespace skybake {
namespace {

constexpr int kRepetitions = 5;
constexpr int kQuickRepetitions = 1;
// Bakes that take longer are timed once.
constexpr double kLongBake_s = 0.5;
// Variants of more voxels are left out, unless the recipe itself has as many.
constexpr double kMostVariantVoxels = 1 << 25;

double milliseconds(double seconds) { return std::round(seconds * 1e9) / 1e6; }  // whole ns

// The bytes of a variant's files, and the time that they take.
struct Written {
    std::uint64_t bytes = 0;
    double seconds = 0;
};

class VariantMeasurement {
  public:
    VariantMeasurement(const Recipe& recipe, const Bake& bake, const ReportOptions& options)
        : recipe_(recipe), bake_(bake), options_(options) {}

    // Bakes it with its certificate, on all threads.
    Outcome<Baked> bake(bool compares_with_paths) const {
        BakeOptions options = bake_options(options_.threads);
        options.certification = options_.quick ? Certification::quick : Certification::full;
        return compares_with_paths ? bake_asset(recipe_, bake_, options) : bake_alone(options);
    }

    // The median of bakes without certificate on one thread, which find what others share.
    std::optional<double> seconds() const {
        BakeOptions options = bake_options(1);
        options.certification = Certification::off;
        if (config::kind_of(bake_).facts.use_of_light == config::UseOfLight::none) {
            options.intermediates = nullptr;  // what is held is no light, but the asset itself
        }
        std::vector<double> times;
        const int most = options_.quick ? kQuickRepetitions : kRepetitions;
        while (static_cast<int>(times.size()) < most) {
            const double begin = thread_cpu_seconds();
            static_cast<void>(bake_alone(options));
            if (is_cancelled(options_.progress)) return std::nullopt;
            times.push_back(thread_cpu_seconds() - begin);
            if (times.back() > kLongBake_s) break;
        }
        std::ranges::sort(times);
        return times[times.size() / 2];
    }

    // Writes all files to memory. After an interruption there is neither a value nor a diagnostic.
    Outcome<Written> write(const Baked& baked) const {
        const ManifestAsset asset = describe_with_files(baked);
        Written written;
        const double begin = thread_cpu_seconds();
        for (const ManifestFile& file : asset.files) {
            const MemoryFile memory;
            auto outcome =
                write_asset_file(baked, asset, file, 1, options_.progress, memory.path());
            if (!outcome.diagnostics.empty()) return {{}, std::move(outcome.diagnostics)};
            if (is_cancelled(options_.progress)) return {};
            written.bytes += memory.bytes();
        }
        written.seconds = thread_cpu_seconds() - begin;
        return {written, {}};
    }

  private:
    BakeOptions bake_options(int threads) const {
        return {.threads = threads,
                .progress = options_.progress,
                .intermediates = options_.intermediates};
    }

    Outcome<Baked> bake_alone(const BakeOptions& options) const {
        AssetLabel label;
        label.name = bake_.name;
        return baker_of(bake_).bake(recipe_.parameters, bake_, options, std::move(label));
    }

    const Recipe& recipe_;
    const Bake& bake_;
    const ReportOptions& options_;
};

double voxels_of(const Recipe& recipe, const Bake& bake) {
    double voxels = 1;
    for (const int count : baker_of(bake).estimate(recipe.parameters, bake).size) voxels *= count;
    return voxels;
}

// Marks the rows that no other beats in a cost.
void mark_front(std::vector<ReportRow>& rows, double (*cost)(const ReportRow&), double noise,
                bool ReportRow::*mark) {
    std::vector<CostAndError> choices;
    for (const ReportRow& row : rows) {
        choices.push_back({cost(row), to_digits(row.lookup.rms, 2)});
    }
    const std::vector<bool> front = pareto_front(choices, noise);
    for (std::size_t i = 0; i < rows.size(); ++i) rows[i].*mark = front[i];
}

void describe(const Baked& baked, const ReportOptions& options, AssetReport& report) {
    report.kind = baked.kind;
    const Certificate& certificate = baked.certificate;
    report.reference = certificate.reference;
    report.scale = certificate.scale;
    report.texel_points = certificate.texel_points;
    report.lookup_points = certificate.lookup_points;
    report.sky = certificate.sky;
    report.timing =
        "processor time of a bake without its certificate, one thread; light that variants share "
        "is not in it";
    report.repetitions = options.quick ? kQuickRepetitions : kRepetitions;
}

ReportRow row_of(const Variant& variant, const Baked& baked) {
    ReportRow row;
    row.asset = baked.name;
    row.family = variant.family;
    row.variant = variant.name;
    row.baseline = variant.baseline;
    row.of_recipe = variant.settings.empty();
    const std::array<int, 3>& size = baked.levels.front().size;
    row.size.assign(size.begin(), size.begin() + (baked.is_table() ? 2 : 3));
    row.pixel_type = baked.pixel_type;
    row.texel = baked.certificate.texel;
    row.lookup = baked.certificate.lookup;
    return row;
}

// Measures one variant and adds its row. Returns what a fault of the recipe itself reports; a variant
// that the recipe does not allow adds nothing.
Outcome<bool> add_row(const LoadRecipe& load, const Recipe& recipe, const Bake& bake,
                      const Variant& variant, const ReportOptions& options, AssetReport& report) {
    const bool of_recipe = variant.settings.empty();
    Outcome<Recipe> changed;
    if (!of_recipe) changed = load(variant.settings);
    if (!of_recipe && !changed.value) return {true, {}};
    const Recipe& own = of_recipe ? recipe : *changed.value;
    const auto& bakes = own.parameters.bakes;
    const auto found = std::ranges::find(bakes, bake.name, &Bake::name);
    if (found == bakes.end()) return {true, {}};
    const double voxels = voxels_of(own, *found);
    if (!of_recipe && voxels > std::max(kMostVariantVoxels, voxels_of(recipe, bake))) {
        report.notes.push_back(fmt::format("{} {}: left out, since it has too many voxels",
                                           variant.family, variant.name));
        return {true, {}};
    }
    const VariantMeasurement measurement(own, *found, options);
    Outcome<Baked> baked = measurement.bake(of_recipe);
    if (is_cancelled(options.progress)) return {};
    if (!baked.value) {
        if (!of_recipe) {
            report.notes.push_back(fmt::format("{} {}: {}", variant.family, variant.name,
                                               baked.diagnostics.front().message));
            return {true, {}};
        }
        return {{}, std::move(baked.diagnostics)};
    }
    if (of_recipe) describe(*baked.value, options, report);
    ReportRow row = row_of(variant, *baked.value);
    const Outcome<Written> written = measurement.write(*baked.value);
    const std::optional<double> seconds = measurement.seconds();
    if (!written.value || !seconds) return {{}, written.diagnostics};
    row.file_bytes = written.value->bytes;
    row.write_ms = milliseconds(written.value->seconds);
    row.time_ms = milliseconds(*seconds);
    report.rows.push_back(std::move(row));
    return {true, of_recipe ? std::move(baked.diagnostics) : std::vector<Diagnostic>{}};
}

}  // namespace

Outcome<AssetReport> report_asset(const LoadRecipe& load, const Recipe& recipe, const Bake& bake,
                                  const ReportOptions& options) {
    Outcome<AssetReport> outcome;
    AssetReport report;
    report.name = bake.name;
    for (const Variant& variant : variants_of(recipe, bake)) {
        Outcome<bool> added = add_row(load, recipe, bake, variant, options, report);
        if (!added.value) return {{}, std::move(added.diagnostics)};
        std::ranges::move(added.diagnostics, std::back_inserter(outcome.diagnostics));
    }
    mark_front(
        report.rows, [](const ReportRow& row) { return row.time_ms; }, kTimingNoise,
        &ReportRow::on_time_front);
    mark_front(
        report.rows, [](const ReportRow& row) { return static_cast<double>(row.file_bytes); }, 0,
        &ReportRow::on_bytes_front);
    outcome.value = std::move(report);
    return outcome;
}

}  // namespace skybake
