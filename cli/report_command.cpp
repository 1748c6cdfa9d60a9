// skybake report: what accuracy costs, for each asset of a recipe.
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "bakers/io/atomic_file.h"
#include "bakers/io/output_folder.h"
#include "bakers/report/report.h"
#include "bakers/report/report_files.h"
#include "bakers/report/report_text.h"
#include "cli/bake_progress.h"
#include "cli/command.h"
#include "cli/console.h"
#include "cli/interrupt.h"
#include "cli/parse_arguments.h"
#include "cli/report_table.h"
#include "config/suggest.h"

namespace skybake::cli {
namespace {

using config::Bake;
using config::Diagnostic;
using config::Outcome;
using config::Recipe;

// What is wrong with the options, apart from what their table says.
std::vector<Diagnostic> check_options(const Invocation& invocation, const Recipe& recipe) {
    std::vector<Diagnostic> diagnostics;
    if (invocation.has("json") && invocation.has("csv")) {
        diagnostics.push_back(
            usage_error("--json and --csv exclude each other", "the folder will hold both"));
    }
    std::vector<std::string_view> names;
    for (const Bake& bake : recipe.parameters.bakes) names.push_back(bake.name);
    for (const std::string& name : invocation.values("only")) {
        if (std::find(names.begin(), names.end(), name) != names.end()) continue;
        diagnostics.push_back(usage_error(fmt::format("--only: the recipe has no [bake.{}]", name),
                                          config::did_you_mean(name, names)));
    }
    if (names.empty()) {
        diagnostics.push_back(usage_error("the recipe asks for nothing: it has no [bake.*]",
                                          "add [bake.transmittance]"));
    }
    return diagnostics;
}

std::optional<int> thread_option(const Invocation& invocation) {
    if (!invocation.has("jobs")) return 0;
    const std::string text = invocation.value("jobs");
    int threads = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), threads);
    const bool whole = error == std::errc() && end == text.data() + text.size();
    if (!whole || threads < 1 || threads > 1024) return std::nullopt;
    return threads;
}

std::vector<const Bake*> chosen_bakes(const Recipe& recipe, const std::vector<std::string>& only) {
    std::vector<const Bake*> bakes;
    for (const Bake& bake : recipe.parameters.bakes) {
        const bool wanted =
            only.empty() || std::find(only.begin(), only.end(), bake.name) != only.end();
        if (wanted) bakes.push_back(&bake);
    }
    return bakes;
}

// Whether the report may be written: asked before the minute that it takes.
std::vector<Diagnostic> check_folder(const std::filesystem::path& folder,
                                     const std::vector<const Bake*>& bakes, bool force) {
    // No file is named: report_files.h knows its own, which no manifest claims.
    std::vector<Diagnostic> diagnostics = inspect_output_folder(folder, {}, true).diagnostics;
    if (force || !diagnostics.empty()) return diagnostics;
    std::vector<std::string> names;
    for (const Bake* bake : bakes) names.push_back(bake->name);
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
    const auto recipe = config::load_recipe(invocation.arguments()[0], invocation.values("set"));
    if (const ExitCode code = console.report(recipe.diagnostics); !recipe.value) return code;
    std::vector<Diagnostic> problems = check_options(invocation, *recipe.value);
    const auto threads = thread_option(invocation);
    if (!threads) {
        problems.push_back(usage_error(
            fmt::format("-j: `{}` is not a number of threads", invocation.value("jobs")),
            "1 to 1024"));
    }
    if (!problems.empty()) return console.report(problems);

    const auto bakes = chosen_bakes(*recipe.value, invocation.values("only"));
    const std::filesystem::path folder = invocation.value("output");
    problems = check_folder(folder, bakes, invocation.has("force"));
    if (!problems.empty()) return console.report(problems);

    std::vector<AssetReport> reports;
    for (const Bake* bake : bakes) {
        BakeProgress progress(bake->name, console);
        const ReportOptions options{*threads, invocation.has("quick"), &progress};
        Outcome<AssetReport> report = report_asset(*recipe.value, *bake, options);
        progress.finish();
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
        .summary = "measure what accuracy costs: time, error and bytes of many variants",
        .arguments = {{.name = "recipe.toml", .help = "the recipe"}},
        .options = {{.name = "output",
                     .short_name = 'o',
                     .value = "FOLDER",
                     .help = "where report.csv, report.json and NAME.svg go",
                     .fallback = "report"},
                    {.name = "set",
                     .value = "KEY=VALUE",
                     .help = "override a value of the recipe",
                     .repeatable = true},
                    {.name = "only",
                     .value = "NAME",
                     .help = "report on [bake.NAME] alone",
                     .repeatable = true},
                    {.name = "quick", .help = "fewer repetitions, sizes and points"},
                    {.name = "jobs",
                     .short_name = 'j',
                     .value = "N",
                     .help = "threads for references; timing takes one (default: all)"},
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
