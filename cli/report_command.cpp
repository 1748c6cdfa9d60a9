// skybake report: what accuracy costs, for each asset of a recipe.
#include <fmt/format.h>

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "bakers/report/report.h"
#include "bakers/report/report_files.h"
#include "bakers/report/report_text.h"
#include "cli/bake_progress.h"
#include "cli/bake_selection.h"
#include "cli/cache_folder.h"
#include "cli/command.h"
#include "cli/console.h"
#include "cli/interrupt.h"
#include "cli/parse_arguments.h"
#include "cli/recipe_argument.h"
#include "cli/report_output.h"
#include "cli/report_table.h"
#include "cli/report_truth.h"

namespace skybake::cli {
namespace {

using config::Bake;
using config::Outcome;

ExitCode run_report(const Invocation& invocation, Console& console) {
    if (invocation.has("json") && invocation.has("csv")) {
        return console.report(std::array{usage_error("--json and --csv exclude each other",
                                                     "the folder gets both in any case")});
    }
    if (invocation.has("truth")) return report_truth(invocation, console);
    if (invocation.has("truth-paths")) {
        return console.report(std::array{usage_error(
            "--truth-paths needs --truth", "it sets the number of paths that trace the sky")});
    }
    const auto selection = select_bakes(invocation);
    if (const ExitCode code = console.report(selection.diagnostics); !selection.value) return code;
    const std::vector<Bake>& bakes = selection.value->bakes;
    const std::filesystem::path folder = invocation.value("output");
    std::vector<std::string> names;
    for (const Bake& bake : bakes) names.push_back(bake.name);
    const auto problems =
        check_report_folder(folder, report_file_names(names), invocation.has("force"));
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
    if (const ExitCode code = write_report_files(report_files(reports), folder, console);
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
        .brief = "measure accuracy's cost",
        .summary = "measure what accuracy costs: time, error and bytes of many variants",
        .arguments = {{.name = "recipe.toml", .help = recipe_help}},
        .options = {{.name = "output",
                     .short_name = 'o',
                     .value = "FOLDER",
                     .help = "write report.csv, report.json and NAME.svg into this folder",
                     .fallback = "report"},
                    set_option(),
                    only_option("report on [bake.NAME] only"),
                    {.name = "truth",
                     .help = "compare each method of multiple scattering with path tracing"},
                    {.name = "truth-paths",
                     .value = "N",
                     .help = "trace N paths per direction on average (default: 131072)"},
                    cache_option(),
                    {.name = "quick", .help = "use fewer repetitions, sizes, points and paths"},
                    jobs_option("use N threads for references; timing uses one (default: all)"),
                    {.name = "force", .help = "overwrite files that no report has written"},
                    {.name = "csv",
                     .help = "print CSV instead of the table (--json: report.json)"}},
        .examples = {{"skybake report earth.toml", "prints tables, writes plots into ./report"},
                     {"skybake report earth.toml --only transmittance --quick --csv > earth.csv",
                      "measures one asset in seconds, for a spreadsheet"},
                     {"skybake report --truth earth.toml",
                      "measures the error of the sky and keeps the traced reference"}},
        .exit_codes = {ExitCode::io, ExitCode::checks},
        .run = run_report};
}

}  // namespace skybake::cli
