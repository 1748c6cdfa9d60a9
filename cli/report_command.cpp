// skybake report: shows what accuracy costs, for each asset of a recipe.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "bakers/assets/description/certificate_warnings.h"
#include "bakers/assets/registry/registry.h"
#include "bakers/io/files/atomic_file.h"
#include "bakers/io/files/output_folder.h"
#include "bakers/io/files/temporary_file.h"
#include "bakers/io/files/to_string.h"
#include "bakers/math/intermediates.h"
#include "bakers/plot/drawing.h"
#include "bakers/report/report.h"
#include "bakers/report/report_files.h"
#include "bakers/report/sweeps/sweep.h"
#include "cli/command.h"
#include "cli/console.h"
#include "cli/options.h"
#include "cli/progress.h"
#include "cli/report.h"
#include "cli/table_printer.h"

namespace skybake::cli {
namespace {

// Writes three significant digits without an exponent, so that columns are easy to compare.
std::string duration_text(double milliseconds) {
    const int decimals = milliseconds < 10 ? 2 : milliseconds < 100 ? 1 : 0;
    return fmt::format("{:.{}f} ms", milliseconds, decimals);
}

std::string error_text(const ErrorFigures& figures) {
    return fmt::format("{:.1e} / {:.1e}", figures.max, figures.rms);
}

std::string front_text(const ReportRow& row) {
    std::vector<std::string_view> fronts;
    if (row.on_lookup_front) fronts.emplace_back("lookup");
    if (row.on_texel_front) fronts.emplace_back("texel");
    if (row.volume_file && row.volume_file->on_bytes_front) fronts.emplace_back("bytes");
    return fmt::format("{}", fmt::join(fronts, ", "));
}

std::string remark_of(const ReportRow& row) {
    const std::string_view own = row.of_recipe ? "this recipe" : "";
    if (row.baseline.empty()) return std::string(own);
    return fmt::format("{}{}baseline: {}", own, own.empty() ? "" : ", ", row.baseline);
}

// This is a column of the table. Columns that only volumes have are left out of other tables.
struct Column {
    std::string_view title;
    Align align;
    std::string (*cell)(const ReportRow& row);
    bool of_volumes = false;
};

constexpr std::array<Column, 10> kColumns = {{
    {"variant", Align::left, [](const ReportRow& row) { return row.variant; }},
    {"size", Align::right, [](const ReportRow& row) { return size_text(row.size); }},
    {"type", Align::left,
     [](const ReportRow& row) { return std::string(to_string(row.pixel_type)); }},
    {"file", Align::right,
     [](const ReportRow& row) { return byte_size_text(static_cast<double>(row.file_bytes)); }},
    {"time", Align::right, [](const ReportRow& row) { return duration_text(row.time_ms); }},
    {"write", Align::right,
     [](const ReportRow& row) { return duration_text(row.volume_file->write_ms); }, true},
    {"texel error max / rms", Align::right,
     [](const ReportRow& row) { return error_text(row.texel); }},
    {"lookup error max / rms", Align::right,
     [](const ReportRow& row) { return error_text(row.lookup); }},
    {"front", Align::left, front_text},
    {"", Align::left, remark_of},
}};

std::string rows_text(const AssetReport& asset) {
    std::vector<Align> alignment = {Align::left};
    std::vector<std::string> heading = {"family"};
    std::vector<const Column*> columns;
    for (const Column& column : kColumns) {
        if (column.of_volumes && !asset.volume) continue;
        columns.push_back(&column);
        alignment.push_back(column.align);
        heading.emplace_back(column.title);
    }
    TextTable table(alignment);
    table.add_row(heading);
    std::string family;
    for (const ReportRow& row : asset.rows) {
        std::vector<std::string> cells = {row.family == family ? "" : row.family};
        for (const Column* column : columns) cells.push_back(column->cell(row));
        table.add_row(std::move(cells));
        family = row.family;
    }
    return table.text();
}

std::string volume_text(const VolumeFacts& volume) {
    const int count = volume.write_repetitions;
    std::string text =
        fmt::format("  write: processor time to encode a file in memory, one thread, {}\n",
                    count == 1 ? "once" : fmt::format("median of {}", count));
    for (std::size_t c = 0; c < volume.channels.size(); ++c) {
        const ValueStatistics& channel = volume.statistics[c];
        text += fmt::format("  {}: {:.4f} to {:.4f}, mean {:.4f}\n", volume.channels[c],
                            channel.min, channel.max, channel.mean);
    }
    return text + fmt::format("  seam: {:.2g}\n", volume.seam_error);
}

std::string notes_text(const AssetReport& asset) {
    std::string text;
    for (const std::string& note : asset.notes) text += fmt::format("  {}\n", note);
    return text;
}

std::string skipping_text(const AssetReport& asset) {
    const SkippingFacts& skipping = *asset.skipping;
    TextTable table({Align::left, Align::right, Align::right, Align::right, Align::right,
                     Align::right, Align::right, Align::right, Align::right});
    table.add_row({"structure", "occupied", "lost samples", "rays changed", "up", "within", "down",
                   "bytes", "time"});
    for (const SkippingRow& row : skipping.rows) {
        table.add_row({row.structure, fmt::format("{:.2f} %", 100 * row.occupied_share),
                       fmt::format("{} of {}", row.lost_samples, row.samples),
                       fmt::format("{}", row.changed_rays), fmt::format("{:.1f}", row.fetches[0]),
                       fmt::format("{:.1f}", row.fetches[1]), fmt::format("{:.1f}", row.fetches[2]),
                       byte_size_text(static_cast<double>(row.structure_bytes)),
                       duration_text(row.time_ms)});
    }
    return fmt::format(
        "{} ({})\n"
        "  cells of {} voxels over {}; the smallest safe share of occupied cells is {:.2f} %\n"
        "  up, within, down: lookups of density and structure per ray, mean of {} rays each, up to "
        "500 steps of 1/600 tile\n"
        "  time: {}, median of {}\n\n{}",
        asset.name, asset.kind, skipping.cell, size_text(skipping.size),
        100 * skipping.smallest_safe_share, skipping.rays, asset.timing, asset.repetitions,
        table.text());
}

std::string title_of(const AssetReport& asset) {
    return asset.kind == asset.name ? asset.name : fmt::format("{} ({})", asset.name, asset.kind);
}

std::string sky_text(const std::optional<SkyError>& sky) {
    if (!sky) return "";
    if (sky->points == 0) {
        return fmt::format("  sky error: too noisy to tell, against {}\n", sky->reference);
    }
    return fmt::format(
        "  sky error: {} % (median), {} % (nine in ten are below), {} % (largest, at {}), against "
        "{}, "
        "whose standard error is {} %\n",
        to_percent(sky->median), to_percent(sky->ninth_decile), to_percent(sky->max), sky->worst,
        sky->reference, to_percent(sky->standard_error));
}

std::string asset_text(const AssetReport& asset) {
    const std::string title = fmt::format("{}\n{}", title_of(asset), sky_text(asset.sky));
    if (asset.rows.empty()) return title + notes_text(asset);
    std::string text = title;
    text += fmt::format(
        "  lookup error: {}, against {} ({} lookups, up to {} texels)\n  time: {}, median of "
        "{}\n{}  "
        "front: no other variant has a smaller error of lookups, or of texels at one size, in as "
        "little time (within 5 %){}\n\n",
        asset.scale, asset.reference, asset.lookup_points, asset.texel_points, asset.timing,
        asset.repetitions, asset.volume ? volume_text(*asset.volume) : "",
        asset.volume
            ? "; errors have two digits; bytes: no other has a smaller error in as few bytes"
            : "");
    text += rows_text(asset);
    return text + notes_text(asset);
}

std::string report_text(const AssetReport& asset) {
    return asset.skipping ? skipping_text(asset) + notes_text(asset) : asset_text(asset);
}

using config::Bake;
using config::Outcome;

std::string report_table(const std::vector<AssetReport>& assets) {
    std::string text;
    for (const AssetReport& asset : assets) {
        text += fmt::format("{}{}", text.empty() ? "" : "\n", report_text(asset));
    }
    return text;
}

ExitCode run_report(const Invocation& invocation, Console& console) {
    if (invocation[options::json] && invocation[options::csv]) {
        return console.report(std::array{usage_error("--json and --csv exclude each other",
                                                     "the folder gets both in any case")});
    }
    if (invocation[options::colors]) return report_color(invocation, console);
    if (invocation[options::truth]) return report_truth(invocation, console);
    if (invocation.has(options::truth_paths)) {
        return console.report(std::array{usage_error(
            "--truth-paths needs --truth", "it sets the number of paths that trace the sky")});
    }
    const auto selection = select_bakes(invocation);
    if (const ExitCode code = console.report(selection.diagnostics); !selection.value) return code;
    const std::vector<Bake>& bakes = selection.value->bakes;
    const std::filesystem::path folder = invocation[options::output];
    std::vector<std::string> names;
    for (const Bake& bake : bakes) names.push_back(bake.name);
    const auto problems =
        check_report_folder(folder, report_file_names(names), invocation[options::force]);
    if (!problems.empty()) return console.report(problems);
    if (const auto problem = chart_problem()) {  // only a warning if just the font is missing
        const ExitCode code = console.report(std::array{*problem});
        if (code != ExitCode::done) return code;
    }

    Intermediates intermediates(BakeOptions().held_voxel_bytes);
    const auto expected = intermediates.expect(
        needs_of(selection.value->recipe.parameters, bakes, Certification::quick));
    std::vector<AssetReport> reports;
    for (const Bake& bake : bakes) {
        Outcome<AssetReport> report = [&] {
            BakeProgress progress(bake.name, console, static_cast<int>(reports.size()) + 1,
                                  static_cast<int>(bakes.size()));
            const ReportOptions options{selection.value->threads, invocation[options::quick],
                                        &progress, &intermediates};
            return report_asset(selection.value->recipe, bake, options);
        }();
        if (interrupted()) return ExitCode::interrupted;
        if (const ExitCode code = console.report(report.diagnostics); !report.value) return code;
        reports.push_back(std::move(*report.value));
    }
    if (const ExitCode code = write_report_files(report_files(reports), folder, console);
        code != ExitCode::done) {
        return code;
    }
    console.result(invocation[options::json]  ? report_json(reports)
                   : invocation[options::csv] ? report_csv(reports)
                                              : report_table(reports));
    return ExitCode::done;
}

}  // namespace

std::vector<config::Diagnostic> check_report_folder(const std::filesystem::path& folder,
                                                    const std::vector<std::string>& names,
                                                    bool force) {
    // No file is named here, because report_files.h knows the files of a report and no manifest
    // claims them.
    auto diagnostics = inspect_output_folder(folder, {}, true).diagnostics;
    if (force || !diagnostics.empty()) return diagnostics;
    return foreign_report_files(folder, names);
}

ExitCode write_report_files(const std::vector<ReportFile>& files,
                            const std::filesystem::path& folder, Console& console) {
    const auto made = create_output_folder(folder);
    if (const ExitCode code = console.report(made.diagnostics); !made.value) return code;
    remove_stale_temporaries_in(folder);
    const BakeProgress progress("write", console);
    AtomicFiles atomic;
    for (const ReportFile& file : files) {
        const auto staged = atomic.stage(folder / file.name, file.text, &progress);
        if (const ExitCode code = console.report(staged.diagnostics); !staged.value) return code;
        if (*staged.value == WriteResult::interrupted) return ExitCode::interrupted;
    }
    if (const auto diagnostics = atomic.commit(); !diagnostics.empty()) {
        return console.report(diagnostics);
    }
    for (const ReportFile& file : files) console.note((folder / file.name).string() + "\n");
    return ExitCode::done;
}

Command report_command() {
    return {
        .name = "report",
        .brief = "measure accuracy's cost",
        .summary = "measure what accuracy costs: time, error and bytes of many variants",
        .arguments = {{.name = "recipe.toml", .help = recipe_help}},
        .options = {options::output("write report.csv, report.json and NAME.svg into this folder",
                                    "report"),
                    set_row(), options::only("report on [bake.NAME] only"),
                    options::truth("compare each method of multiple scattering with path tracing"),
                    options::colors("compare numbers of wavelengths by their colours and times"),
                    options::truth_paths(
                        "trace N paths per direction on average (default: 131072)"),
                    cache_row(), options::quick("use fewer repetitions, sizes, points and paths"),
                    options::jobs("use N threads for references; timing uses one (default: all)"),
                    options::force("overwrite files that no report has written"),
                    options::csv("print CSV instead of the table (--json: report.json)")},
        .examples = {{"skybake report earth.toml", "prints tables, writes plots into ./report"},
                     {"skybake report earth.toml --only transmittance --quick --csv > earth.csv",
                      "measures one asset in seconds, for a spreadsheet"},
                     {"skybake report --truth earth.toml",
                      "measures the error of the sky and keeps the traced reference"},
                     {"skybake report --colors earth.toml",
                      "measures what 3, 4, 8 and 16 wavelengths cost"}},
        .exit_codes = {ExitCode::io, ExitCode::checks},
        .run = run_report};
}

}  // namespace skybake::cli
