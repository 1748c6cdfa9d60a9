// skybake report: what accuracy costs, for each asset of a recipe.
#include <fmt/format.h>

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "bakers/io/atomic_file.h"
#include "bakers/io/output_folder.h"
#include "bakers/report/report.h"
#include "bakers/report/report_files.h"
#include "bakers/report/report_text.h"
#include "cli/bake_progress.h"
#include "cli/bake_selection.h"
#include "cli/command.h"
#include "cli/console.h"
#include "cli/interrupt.h"
#include "cli/parse_arguments.h"
#include "cli/report_table.h"

namespace skybake::cli {
namespace {

using config::Bake;
using config::Diagnostic;
using config::Outcome;

// Whether the report may be written: asked before the minute that it takes.
std::vector<Diagnostic> check_folder(const std::filesystem::path& folder,
                                     const std::vector<Bake>& bakes, bool force) {
    // No file is named: report_files.h knows its own, which no manifest claims.
    std::vector<Diagnostic> diagnostics = inspect_output_folder(folder, {}, true).diagnostics;
    if (force || !diagnostics.empty()) return diagnostics;
    std::vector<std::string> names;
    for (const Bake& bake : bakes) names.push_back(bake.name);
    return foreign_report_files(folder, report_file_names(names));
}

ExitCode write_files(const std::vector<ReportFile>& files, const std::filesystem::path& folder,
                     Console& console) {
    const auto made = create_output_folder(folder);
    if (const ExitCode code = console.report(made.diagnostics); !made.value) return code;
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

ExitCode run(const Invocation& invocation, Console& console) {
    if (invocation.has("json") && invocation.has("csv")) {
        return console.report(std::array{
            usage_error("--json and --csv exclude each other", "the folder will hold both")});
    }
    const auto selection = select_bakes(invocation);
    if (const ExitCode code = console.report(selection.diagnostics); !selection.value) return code;
    const std::vector<Bake>& bakes = selection.value->bakes;
    const std::filesystem::path folder = invocation.value("output");
    const std::vector<Diagnostic> problems = check_folder(folder, bakes, invocation.has("force"));
    if (!problems.empty()) return console.report(problems);

    std::vector<AssetReport> reports;
    for (const Bake& bake : bakes) {
        Outcome<AssetReport> report = [&] {
            BakeProgress progress(bake.name, console);
            const ReportOptions options{selection.value->threads, invocation.has("quick"),
                                        &progress};
            return report_asset(selection.value->recipe, bake, options);
        }();
        if (interrupted()) return ExitCode::interrupted;
        if (const ExitCode code = console.report(report.diagnostics); !report.value) return code;
        reports.push_back(std::move(*report.value));
    }
    if (const ExitCode code = write_files(report_files(reports), folder, console);
        code != ExitCode::done) {
        return code;
    }
    console.result(invocation.has("json")  ? report_json(reports)
                   : invocation.has("csv") ? report_csv(reports)
                                           : report_table(reports));
    return ExitCode::done;
}

}  // namespace

Command report_command() {
    return {
        .name = "report",
        .brief = "what accuracy costs",
        .summary = "measure what accuracy costs: time, error and bytes of many variants",
        .arguments = {{.name = "recipe.toml", .help = "the recipe"}},
        .options = {{.name = "output",
                     .short_name = 'o',
                     .value = "FOLDER",
                     .help = "where report.csv, report.json and NAME.svg go",
                     .fallback = "report"},
                    set_option(),
                    only_option("report on [bake.NAME] alone"),
                    {.name = "quick", .help = "fewer repetitions, sizes and points"},
                    jobs_option("threads for references; timing takes one (default: all)"),
                    {.name = "force", .help = "overwrite files that are not a report's"},
                    {.name = "json", .help = "JSON on stdout in place of the table"},
                    {.name = "csv", .help = "CSV on stdout in place of the table"}},
        .examples = {{"skybake report earth.toml", "tables here, plots in ./report"},
                     {"skybake report earth.toml --only transmittance --quick --csv > earth.csv",
                      "one asset, in seconds, for a spreadsheet"}},
        .exit_codes = {ExitCode::io, ExitCode::checks},
        .run = run};
}

}  // namespace skybake::cli
