#include "bakers/report/report.h"

#include <charconv>
#include <string_view>
#include <utility>
#include <variant>

#include "bakers/atmosphere/medium.h"
#include "bakers/registry.h"
#include "bakers/report/measure_sweep.h"
#include "bakers/report/multiple_scattering_sweep.h"
#include "bakers/report/transmittance_sweep.h"

namespace skybake {

using config::Bake;
using config::MultipleScatteringBake;
using config::MultipleScatteringMethod;
using config::Outcome;
using config::TransmittanceBake;

namespace {

constexpr int kRepetitions = 9;
constexpr int kQuickRepetitions = 3;

// The quadrature level, from 0, that a bake chose: "4 of 9" among its details.
int chosen_level(const BakedTable& table) {
    int level = 1;
    for (const auto& [key, text] : table.details) {
        if (key == "quadrature_level") std::from_chars(text.data(), text.data() + text.size(), level);
    }
    return level - 1;
}

// What the report is about: for multiple scattering the converged method, which the paper's is one
// variant of.
Bake subject(const Bake& bake) {
    Bake result = bake;
    if (auto* asset = std::get_if<MultipleScatteringBake>(&result.asset)) {
        asset->method = MultipleScatteringMethod::converged;
    }
    return result;
}

Sweep sweep_of(const Bake& bake, const Medium& medium, const BakedTable& baked,
               const ReportOptions& options) {
    const std::array<int, 2> size = {baked.image.width, baked.image.height};
    if (const auto* asset = std::get_if<TransmittanceBake>(&bake.asset)) {
        return transmittance_sweep(medium, *asset, size, options.quick);
    }
    return multiple_scattering_sweep(medium, std::get<MultipleScatteringBake>(bake.asset), size,
                                     chosen_level(baked), options.quick, options.threads);
}

}  // namespace

Outcome<AssetReport> report_asset(const config::Recipe& recipe, const Bake& bake,
                                  const ReportOptions& options) {
    Outcome<AssetReport> outcome;
    const BakeOptions bake_options{.threads = options.threads, .progress = options.progress};
    Outcome<BakedTable> baked = bake_table(recipe, subject(bake), bake_options);
    if (options.progress != nullptr && options.progress->cancelled()) return outcome;
    outcome.diagnostics = std::move(baked.diagnostics);
    if (!baked.value) return outcome;

    AssetReport report;
    report.name = bake.name;
    report.kind = baked.value->kind;
    report.reference = baked.value->certificate.reference;
    report.scale = baked.value->certificate.scale;
    report.repetitions = options.quick ? kQuickRepetitions : kRepetitions;
    const Medium medium = make_medium(recipe.parameters.atmosphere);
    const Sweep sweep = sweep_of(bake, medium, *baked.value, options);
    report.timing = sweep.timing;
    report.texel_points = sweep.texels.rows * sweep.texels.per_row;
    report.lookup_points = sweep.lookups.rows * sweep.lookups.per_row;
    auto measured = measure_sweep(sweep, *baked.value, report.repetitions, options);
    if (!measured) return {};
    report.rows = std::move(measured->rows);
    report.notes = std::move(measured->notes);
    outcome.value = std::move(report);
    return outcome;
}

}  // namespace skybake
