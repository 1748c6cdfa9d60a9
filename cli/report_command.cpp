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
#include "bakers/report/measurement.h"
#include "bakers/report/report.h"
#include "bakers/report/report_files.h"
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
    if (row.on_time_front) fronts.emplace_back("time");
    if (row.on_bytes_front) fronts.emplace_back("bytes");
    return fmt::format("{}", fmt::join(fronts, ", "));
}

std::string rows_text(const AssetReport& asset) {
    TextTable table({Align::left, Align::left, Align::right, Align::left, Align::right,
                     Align::right, Align::right, Align::right, Align::right, Align::left});
    table.add_row({"differs in", "", "size", "type", "files", "time", "write",
                   "texel error max / rms", "lookup error max / rms", "front", ""});
    std::string family;
    for (const ReportRow& row : asset.rows) {
        table.add_row({row.family == family ? "" : row.family, row.variant, size_text(row.size),
                       std::string(to_string(row.pixel_type)),
                       byte_size_text(static_cast<double>(row.file_bytes)),
                       duration_text(row.time_ms), duration_text(row.write_ms),
                       error_text(row.texel), error_text(row.lookup), front_text(row),
                       row.baseline.empty() ? "" : "baseline: " + row.baseline});
        family = row.family;
    }
    return table.text();
}

std::string notes_text(const AssetReport& asset) {
    std::string text;
    for (const std::string& note : asset.notes) text += fmt::format("  {}\n", note);
    return text;
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
        "{}, whose standard error is {} %\n",
        to_percent(sky->median), to_percent(sky->ninth_decile), to_percent(sky->max), sky->worst,
        sky->reference, to_percent(sky->standard_error));
}

std::string asset_text(const AssetReport& asset) {
    const std::string error =
        asset.scale.empty() ? "it has none: it is right, or is not baked"
                            : fmt::format("{}, against {} ({} lookups, {} texels)", asset.scale,
                                          asset.reference, asset.lookup_points, asset.texel_points);
    return fmt::format(
               "{}\n{}  lookup error: {}\n"
               "  time: {}, {}\n"
               "  front: no other variant has a smaller error (RMS) in as little time (within 5 "
               "%), or in as few bytes; errors have two digits\n\n",
               title_of(asset), sky_text(asset.sky), error, asset.timing,
               asset.repetitions == 1 ? "one run"
                                      : fmt::format("median of {}", asset.repetitions)) +
           rows_text(asset) + notes_text(asset);
}

std::string report_table(const std::vector<AssetReport>& assets) {
    std::string text;
    for (const AssetReport& asset : assets) {
        text += fmt::format("{}{}", text.empty() ? "" : "\n", asset_text(asset));
    }
    return text;
}

ExitCode run_report(const Invocation& invocation, Console& console) {
    if (invocation[options::json] && invocation[options::csv]) {
        return console.report(std::array{usage_error("--json and --csv exclude each other",
                                                     "the folder gets both in any case")});
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
            const auto load = [&](std::span<const std::string> settings) {
                return recipe_of(invocation, settings);
            };
            return report_asset(load, selection.value->recipe, bake, options);
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

std::vector<Diagnostic> check_report_folder(const std::filesystem::path& folder,
                                            const std::vector<std::string>& names, bool force) {
    // No file is named here, because report_files.h knows the files of a report and no manifest
    // claims them.
    auto diagnostics = inspect_output_folder(folder, {}, true).diagnostics;
    if (force || !diagnostics.empty()) return diagnostics;
    return foreign_report_files(folder, names);
}

ExitCode write_files(const std::vector<NamedFile>& files, const std::filesystem::path& folder,
                     Console& console) {
    const auto made = create_output_folder(folder);
    if (const ExitCode code = console.report(made.diagnostics); !made.value) return code;
    remove_stale_temporaries_in(folder);
    const BakeProgress progress("write", console);
    AtomicFiles atomic;
    for (const NamedFile& file : files) {
        const auto staged =
            atomic.stage(folder / file.name, std::string_view(file.bytes), &progress);
        if (const ExitCode code = console.report(staged.diagnostics); !staged.value) return code;
        if (*staged.value == WriteResult::interrupted) return ExitCode::interrupted;
    }
    return console.report(atomic.commit());
}

ExitCode write_report_files(const std::vector<NamedFile>& files,
                            const std::filesystem::path& folder, Console& console) {
    const ExitCode code = write_files(files, folder, console);
    if (code != ExitCode::done) return code;
    for (const NamedFile& file : files) console.note((folder / file.name).string() + "\n");
    return code;
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
                    options::quick("use fewer repetitions and points"),
                    options::jobs("use N threads for references; timing uses one (default: all)"),
                    options::force("overwrite files that no report has written"),
                    options::csv("print CSV instead of the table (--json: report.json)")},
        .examples = {{"skybake report earth.toml", "prints tables, writes plots into ./report"},
                     {"skybake report earth.toml --only transmittance --quick --csv > earth.csv",
                      "measures one asset in seconds, for a spreadsheet"}},
        .exit_codes = {ExitCode::io, ExitCode::checks},
        .run = run_report};
}

}  // namespace skybake::cli
