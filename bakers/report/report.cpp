#include "bakers/report/report.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <optional>
#include <string_view>
#include <utility>
#include <variant>

#include "bakers/air/medium.h"
#include "bakers/assets/registry/registry.h"
#include "bakers/assets/sky/traced_light.h"
#include "bakers/field/baked.h"
#include "bakers/report/cloud_light_report.h"
#include "bakers/report/occupancy_report.h"
#include "bakers/report/sweeps/table_sweeps.h"
#include "bakers/report/volume_report.h"
#include "config/assets/bruneton.h"
#include "config/assets/multiple_scattering.h"
#include "config/assets/noise_volume.h"
#include "config/assets/occupancy.h"
#include "config/assets/phase.h"
#include "config/assets/transmittance.h"

namespace skybake {

using config::Bake;
using config::MultipleScatteringBake;
using config::MultipleScatteringMethod;
using config::Outcome;
using config::TransmittanceBake;

namespace {

constexpr int kRepetitions = 9;
constexpr int kQuickRepetitions = 3;

// Returns the quadrature level that a bake chose, counted from 0. The table's details count from 1.
int chosen_level(const Baked& table) {
    for (const auto& [name, value] : table.details) {
        if (name == "quadrature_level") return static_cast<int>(std::get<double>(value)) - 1;
    }
    return 0;
}

bool is_solved(const Bake& bake) {
    const auto* asset = bake.find<MultipleScatteringBake>();
    return asset && asset->method == MultipleScatteringMethod::solved;
}

// Returns the bake that the report is about. For multiple scattering it has the converged method;
// the paper's method is one of the variants. Solved tables have no bound for the error of texels.
Bake subject(const Bake& bake) {
    constexpr double kUsualTexelError = 0.002;
    Bake result = bake;
    if (auto* asset = result.find<MultipleScatteringBake>()) {
        if (is_solved(bake)) asset->max_texel_error = kUsualTexelError;
        asset->method = MultipleScatteringMethod::converged;
    }
    return result;
}

// Returns the bake without a bound for the error of its texels.
Bake without_texel_bound(const Bake& bake) {
    Bake result = bake;
    if (auto* asset = result.find<MultipleScatteringBake>()) {
        asset->max_texel_error = std::numeric_limits<double>::infinity();
    }
    return result;
}

bool misses_texel_bound(const Outcome<Baked>& baked) {
    return std::any_of(baked.diagnostics.begin(), baked.diagnostics.end(),
                       [](const config::Diagnostic& found) { return found.code == "E0404"; });
}

Sweep sweep_of(const Bake& bake, const Medium& medium, const Baked& baked, std::optional<int> level,
               const ReportOptions& options) {
    const std::array<int, 2> size = {baked.image().width, baked.image().height};
    if (const auto* asset = bake.find<TransmittanceBake>()) {
        return transmittance_sweep(medium, *asset, size, options.quick);
    }
    return multiple_scattering_sweep(medium, bake.as<MultipleScatteringBake>(), size, level,
                                     options.quick, options.threads);
}

Outcome<AssetReport> report_table_asset(const config::Recipe& recipe, const Bake& bake,
                                        const ReportOptions& options) {
    Outcome<AssetReport> outcome;
    const BakeOptions bake_options{.threads = options.threads,
                                   .progress = options.progress,
                                   .intermediates = options.intermediates};
    AssetReport report;
    Outcome<Baked> baked = bake_asset(recipe, subject(bake), bake_options);
    const bool holds = !misses_texel_bound(baked);
    if (!holds) {
        // The bake is repeated without the bound, because the report then shows which errors can be
        // reached.
        report.notes.push_back("`bake` refuses it: " + baked.diagnostics.front().message);
        baked = bake_asset(recipe, without_texel_bound(subject(bake)), bake_options);
    }
    if (options.progress != nullptr && options.progress->cancelled()) return outcome;
    outcome.diagnostics = std::move(baked.diagnostics);
    if (!baked.value) return outcome;
    report.name = bake.name;
    report.kind = baked.value->kind;
    report.reference = baked.value->certificate.reference;
    report.scale = baked.value->certificate.scale;
    if (is_solved(bake)) {
        report.notes.push_back(
            "these are variants of method = \"converged\"; the recipe's table is solved");
    } else {
        report.sky = baked.value->certificate.sky;
    }
    report.repetitions = options.quick ? kQuickRepetitions : kRepetitions;
    const Medium medium = make_medium(recipe.parameters.atmosphere);
    const std::optional<int> level =
        holds ? std::optional(chosen_level(*baked.value)) : std::nullopt;
    std::optional<PhaseSource> phases;
    if (const auto* phase = bake.find<config::PhaseBake>()) {
        phases = phase_source(recipe.parameters, *phase, options.threads);
    }
    const Sweep sweep =
        phases ? phase_sweep(*phases, bake.as<config::PhaseBake>(), *baked.value, options.quick)
               : sweep_of(bake, medium, *baked.value, level, options);
    report.timing = sweep.timing;
    report.texel_points = sweep.texels.rows * sweep.texels.per_row;
    report.lookup_points = sweep.lookups.rows * sweep.lookups.per_row;
    auto measured = measure_sweep(sweep, *baked.value, report.repetitions, options);
    if (!measured) return {};
    report.rows = std::move(measured->rows);
    report.notes.insert(report.notes.end(), measured->notes.begin(), measured->notes.end());
    outcome.value = std::move(report);
    return outcome;
}

// The kinds of assets whose variants are compared. For others, the certificate states the error.
struct AssetReporter {
    std::string_view asset;
    Outcome<AssetReport> (*report)(const config::Recipe& recipe, const Bake& bake,
                                   const ReportOptions& options);
};

constexpr AssetReporter kReporters[] = {
    {"transmittance", report_table_asset},
    {"multiple_scattering", report_table_asset},
    {"phase", report_table_asset},
    {"bruneton", report_bruneton},
    {"optical_depth", report_column_volume},
    {"noise_volume", report_noise_volume},
    {"cloud_volume", report_cloud_volume},
    {"cloud_light", report_cloud_light},
    {"occupancy", report_occupancy},
    {"cloud_distance", report_cloud_distance},
};

}  // namespace

Outcome<AssetReport> nothing_to_compare(const Bake& bake) {
    AssetReport report;
    report.name = bake.name;
    report.kind = baker_of(bake).asset;
    report.notes.push_back(fmt::format(
        "no variants of {} are compared: `bake` measures the errors of its lookups", report.kind));
    return {std::move(report), {}};
}

Outcome<AssetReport> report_asset(const config::Recipe& recipe, const Bake& bake,
                                  const ReportOptions& options) {
    const AnyBaker& baker = baker_of(bake);
    const auto reporter =
        std::find_if(std::begin(kReporters), std::end(kReporters),
                     [&](const AssetReporter& one) { return one.asset == baker.asset; });
    Outcome<AssetReport> outcome = reporter != std::end(kReporters)
                                       ? reporter->report(recipe, bake, options)
                                       : nothing_to_compare(bake);
    if (!outcome.value || outcome.value->sky || !baker.traced(recipe.parameters, bake)) {
        return outcome;
    }
    const Outcome<Baked> baked = bake_asset(recipe, bake,
                                            BakeOptions{.threads = options.threads,
                                                        .progress = options.progress,
                                                        .intermediates = options.intermediates});
    if (is_cancelled(options.progress)) return {};
    if (baked.value) outcome.value->sky = baked.value->certificate.sky;
    return outcome;
}

}  // namespace skybake
