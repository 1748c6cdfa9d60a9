// skybake report --colors: what colours cost.
#include <fmt/format.h>

#include <array>
#include <string>
#include <utility>
#include <vector>

#include "bakers/io/files/file_io.h"
#include "bakers/plot/drawing.h"
#include "bakers/report/color/color_report.h"
#include "bakers/report/report_files.h"
#include "cli/command.h"
#include "cli/console.h"
#include "cli/options.h"
#include "cli/progress.h"
#include "cli/report.h"
#include "cli/table_printer.h"
#include "config/recipe/recipe.h"

namespace skybake::cli {

namespace {

using config::Diagnostic;

constexpr const char* kColorCsvName = "color_error.csv";
constexpr const char* kColorJsonName = "color_error.json";
constexpr const char* kColorPlotName = "color_error.svg";

// The wavelengths of the spectra that colours are measured against.
constexpr double kFirst_m = 380e-9;
constexpr double kLast_m = 780e-9;

std::vector<Diagnostic> color_problems(const Invocation& invocation,
                                       const config::Parameters& parameters) {
    const std::string recipe = recipe_name(invocation.arguments()[0]);
    if (!(parameters.atmosphere.top_radius.meters > 0)) {  // no atmosphere
        return {file_error("E0105", recipe, "the recipe has no [atmosphere] and so no sky")};
    }
    for (const config::Length wavelength : parameters.wavelengths) {
        if (wavelength.meters >= kFirst_m && wavelength.meters <= kLast_m) continue;
        Diagnostic problem = file_error(
            "E0147", recipe,
            fmt::format("--colors makes colours of wavelengths from 380 nm to 780 nm only; the "
                        "recipe has {:.4g} nm",
                        wavelength.meters * 1e9));
        problem.label = "choose other wavelengths, such as \"best 4\"";
        return {std::move(problem)};
    }
    return {};
}

std::string color_table(const ColorReport& report) {
    std::vector<Align> alignment(11, Align::right);
    alignment[0] = alignment[1] = alignment[10] = Align::left;
    TextTable table(alignment);
    table.add_row({"wavelengths become colours", "", "time", "ratio", "median", "p90 %", "max",
                   "sun at 5°", "1°", "0°", ""});
    std::string family;
    for (const ColorErrorRow& row : report.rows) {
        const ColorError& error = row.error;
        std::string remark = row.of_recipe ? "this recipe" : "";
        if (!row.baseline.empty()) remark = "baseline: " + row.baseline;
        if (row.on_front) remark = remark.empty() ? "front" : "front, " + remark;
        table.add_row({row.family == family ? "" : row.family, row.variant,
                       fmt::format("{:.0f} ms", row.time_ms), fmt::format("{:.1f}", row.time_ratio),
                       percent_text(error.median), percent_text(error.ninth_decile),
                       percent_text(error.max), percent_text(error.disc[0]),
                       percent_text(error.disc[1]), percent_text(error.disc[2]), remark});
        family = row.family;
    }
    return fmt::format(
        "colours of the sky and of the sun ({} views) against those of whole spectra\n"
        "  error: the largest difference of a channel of {} over luminance, in %: median, 90th "
        "percentile, largest; then of the sun's disc at three elevations\n"
        "  time: processor time of the light of all orders, one thread, median of {}; ratio to the "
        "fastest\n"
        "  front: no other way has a smaller median in as little time (within 5 %)\n\n{}",
        report.rows.front().error.skies, report.space, report.repetitions, table.text());
}

}  // namespace

ExitCode report_color(const Invocation& invocation, Console& console) {
    for (const auto& [is_given, name] : {std::pair{invocation.has(options::only), "--only"},
                                         {invocation[options::truth], "--truth"}}) {
        if (!is_given) continue;
        return console.report(
            std::array{usage_error(fmt::format("{} and --colors exclude each other", name),
                                   "colours are of the whole recipe")});
    }
    const auto recipe = recipe_of(invocation);
    if (const ExitCode code = console.report(recipe.diagnostics); !recipe.value) return code;
    const config::Parameters& parameters = recipe.value->parameters;
    auto problems = color_problems(invocation, parameters);
    const std::filesystem::path folder = invocation[options::output];
    if (problems.empty()) {
        problems = check_report_folder(folder, {kColorCsvName, kColorJsonName, kColorPlotName},
                                       invocation[options::force]);
    }
    if (!problems.empty()) return console.report(problems);
    if (const auto problem = chart_problem()) {  // only a warning if just the font is missing
        const ExitCode code = console.report(std::array{*problem});
        if (code != ExitCode::done) return code;
    }
    const auto report = [&] {
        BakeProgress progress("colours", console);
        return measure_colors(parameters, invocation[options::quick],
                              {.threads = invocation[options::jobs], .progress = &progress});
    }();
    if (!report || interrupted()) return ExitCode::interrupted;
    const std::string csv = color_report_csv(*report);
    const std::string json = color_report_json(*report);
    const ExitCode code = write_report_files({{kColorCsvName, csv},
                                              {kColorJsonName, json},
                                              {kColorPlotName, report_svg(color_figure(*report))}},
                                             folder, console);
    if (code != ExitCode::done) return code;
    console.result(invocation[options::json]  ? json
                   : invocation[options::csv] ? csv
                                              : color_table(*report));
    return ExitCode::done;
}

}  // namespace skybake::cli
