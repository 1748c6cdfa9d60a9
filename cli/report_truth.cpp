#include "cli/report.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>
#include <filesystem>
#include <iterator>
#include <optional>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "bakers/io/files/atomic_file.h"
#include "bakers/io/files/file_io.h"
#include "bakers/io/files/output_folder.h"
#include "bakers/math/vectors.h"
#include "bakers/plot/drawing.h"
#include "bakers/report/report_files.h"
#include "bakers/report/truth/sky_error_pictures.h"
#include "bakers/report/truth/sky_truth_report.h"
#include "bakers/report/truth/sky_truth_store.h"
#include "bakers/workspace/cache_folder.h"
#include "cli/command.h"
#include "cli/console.h"
#include "cli/options.h"
#include "cli/progress.h"
#include "cli/table_printer.h"
#include "config/recipe/recipe.h"

namespace skybake::cli {

config::Outcome<std::int64_t> options::read_truth_paths(const std::string& text) {
    constexpr std::int64_t fewest = 16;
    constexpr std::int64_t most = 1'000'000'000;
    if (const auto paths = parse_count(text, fewest, most)) return {*paths, {}};
    return {{},
            {bad_value("--truth-paths", text,
                       fmt::format("it takes a number from {} to {}", fewest, most))}};
}

std::string percent_text(double share) {
    const double value = 100 * share;
    return fmt::format("{:.{}f}", value, value < 10 ? 2 : value < 100 ? 1 : 0);
}

namespace {

std::string method_time_text(const SkyErrorRow& row) {
    if (!row.method.takes_time()) return "-";
    return fmt::format("{:.{}f} ms", row.time_ms, row.time_ms < 10 ? 2 : row.time_ms < 100 ? 1 : 0);
}

void add_figures(const SkyErrorFigures& error, int channels, std::vector<std::string>& cells) {
    for (const double figure : {error.median, error.p90, error.max}) {
        cells.push_back(percent_text(figure));
    }
    for (const Spectrum& rms : error.dome_rms) cells.push_back(percent_text(joined(rms, channels)));
}

namespace fs = std::filesystem;
using config::Diagnostic;
using config::Outcome;
using Truth = std::vector<SkyTruth>;

constexpr double kCameraAltitudeKm = 0.5;
constexpr std::int64_t kMeanPaths = 131072;
constexpr std::int64_t kQuickMeanPaths = 8192;
constexpr int kRepetitions = 3;
constexpr int kQuickDomePixels = 24;
constexpr const char* kTruthName = "sky_truth.csv";
constexpr const char* kJsonName = "sky_error.json";

struct TruthRequest {
    config::Recipe recipe;
    SkyMedium medium;
    fs::path folder;
    fs::path cache;  // empty: no cache
    std::int64_t mean_paths = 0;
    int threads = 0;
    bool quick = false;
    double altitude_km() const { return std::min(kCameraAltitudeKm, medium.air.thickness_km); }
};

std::int64_t mean_paths_of(const Invocation& invocation) {
    if (invocation.has(options::truth_paths)) return invocation[options::truth_paths];
    return invocation[options::quick] ? kQuickMeanPaths : kMeanPaths;
}

Outcome<TruthRequest> request_of(const Invocation& invocation) {
    if (invocation.has(options::only)) {
        return {{},
                {usage_error("--only and --truth exclude each other",
                             "the sky needs the whole recipe")}};
    }
    auto recipe = recipe_of(invocation);
    Outcome<TruthRequest> outcome;
    outcome.diagnostics = std::move(recipe.diagnostics);
    if (!recipe.value) return outcome;
    if (!(recipe.value->parameters.atmosphere.top_radius.meters > 0)) {  // no atmosphere
        outcome.diagnostics.push_back(file_error("E0105", recipe_name(invocation.arguments()[0]),
                                                 "the recipe has no [atmosphere] and so no sky"));
        return outcome;
    }
    const std::size_t wavelengths = recipe.value->parameters.wavelengths.size();
    if (wavelengths > std::size_t{kMaxChannels}) {
        Diagnostic problem = file_error(
            "E0147", recipe_name(invocation.arguments()[0]),
            fmt::format("--truth compares skies of at most four wavelengths; the recipe has {}",
                        wavelengths));
        problem.label = "--set 'wavelengths=\"best 4\"' takes four";
        outcome.diagnostics.push_back(std::move(problem));
        return outcome;
    }
    TruthRequest request;
    request.medium = make_sky_medium(recipe.value->parameters.atmosphere);
    request.recipe = std::move(*recipe.value);
    request.folder = invocation[options::output];
    auto cache = cache_folder(invocation);
    if (!cache.value) return {{}, std::move(cache.diagnostics)};
    request.cache = std::move(*cache.value);
    request.mean_paths = mean_paths_of(invocation);
    request.threads = invocation[options::jobs];
    request.quick = invocation[options::quick];
    outcome.value = std::move(request);
    return outcome;
}

// Checks the report's folder. A PNG does not say who made it; it counts as a report's if the
// report's JSON is beside it.
std::vector<Diagnostic> check_folder(const TruthRequest& request, bool force) {
    auto problems = check_report_folder(
        request.folder, {kTruthName, kJsonName, "sky_error.csv", "sky_error.svg"}, force);
    std::error_code error;
    if (force || !problems.empty() || fs::exists(request.folder / kJsonName, error)) {
        return problems;
    }
    for (const SkyMethod& method : sky_methods(request.medium, request.quick)) {
        const fs::path path = request.folder / sky_error_picture_name(method);
        if (!fs::exists(path, error)) continue;
        Diagnostic diagnostic = file_error(
            "E0303", path.string(),
            fmt::format("`{}` already exists and is not a report of skybake", path.string()));
        diagnostic.label = "overwrite it with --force, or choose another folder with -o";
        problems.push_back(std::move(diagnostic));
    }
    return problems;
}

// Keeps a text in the cache. If the cache cannot be written to, the report goes on with a warning.
std::vector<Diagnostic> keep_in_cache(const fs::path& cache, const fs::path& path,
                                      const std::string& text) {
    std::vector<Diagnostic> problems = make_cache_folder(cache);
    std::error_code error;
    if (problems.empty()) fs::create_directories(path.parent_path(), error);
    if (error) problems = {file_error("E0301", path.string(), error.message())};
    if (problems.empty()) problems = write_file_atomically(path, text).diagnostics;
    for (Diagnostic& problem : problems) {
        problem.severity = config::Severity::warning;
        problem.code = "W0301";
        problem.message = "the cache could not keep the traced sky: " + problem.message;
    }
    return problems;
}

// Keeps the result as soon as it is there, because the rest of the run may be interrupted.
ExitCode keep(const TruthRequest& request, const std::string& key, const Truth& truth,
              Console& console) {
    const std::string text = stored_sky_truth(truth, key);
    if (!request.cache.empty()) {
        console.report(
            keep_in_cache(request.cache, cached_sky_truth_path(request.cache, key), text));
    }
    return write_report_files({{kTruthName, text}}, request.folder, console);
}

// Takes the result from the cache or from the folder's earlier report, or else traces it.
ExitCode find_truth(const TruthRequest& request, Truth& truth, Console& console) {
    const auto directions = sky_truth_directions(request.altitude_km());
    const std::string key = sky_truth_key(request.recipe, directions, request.mean_paths);
    std::optional<Truth> found;
    if (!request.cache.empty()) {
        found = load_sky_truth(cached_sky_truth_path(request.cache, key), key);
    }
    if (!found) found = load_sky_truth(request.folder / kTruthName, key);
    if (!found) {
        BakeProgress progress("truth", console);
        found = trace_sky_truth_within(request.medium, directions, request.mean_paths,
                                       request.threads, &progress);
    }
    if (!found) return ExitCode::interrupted;
    truth = std::move(*found);
    return keep(request, key, truth, console);
}

ExitCode add_pictures(const TruthRequest& request, const std::vector<MadeSkyMethod>& methods,
                      std::vector<ReportFile>& files, Console& console) {
    SkyErrorPictureOptions options;
    options.camera_altitude_km = request.altitude_km();
    if (request.quick) options.dome_pixels = kQuickDomePixels;
    if (const auto problem = chart_problem()) {  // only a warning if just the font is missing
        const ExitCode code = console.report(std::array{*problem});
        if (code != ExitCode::done) return code;
    }
    BakeProgress progress("sky", console);
    auto pictures =
        sky_error_pictures(request.medium, methods, options, request.threads, &progress);
    if (const ExitCode code = console.report(pictures.diagnostics); !pictures.value) return code;
    std::move(pictures.value->begin(), pictures.value->end(), std::back_inserter(files));
    return ExitCode::done;
}

std::string ladder_text(const std::vector<LadderStep>& ladder) {
    TextTable table({Align::left, Align::right, Align::right, Align::left});
    table.add_row({"the ladder", "typical", "high %", ""});
    for (const LadderStep& step : ladder) {
        table.add_row({step.name, step.size ? percent_text(step.size->typical) : "-",
                       step.size ? percent_text(step.size->high) : "-", step.sentence});
    }
    return "\n" + table.text();
}

std::string sky_truth_table(const SkyErrorReport& report) {
    std::vector<Align> alignment = {Align::left, Align::left};
    std::vector<std::string> heading = {
        "multiple scattering", "", "time", "ratio", "median", "p90 %", "max"};
    for (const double sun : report.sun_zenith_degrees) heading.push_back(fmt::format("{:g}°", sun));
    heading.emplace_back();
    alignment.resize(heading.size() - 1, Align::right);
    TextTable table(alignment);
    table.add_row(std::move(heading));
    std::string family;
    for (const SkyErrorRow& row : report.rows) {
        std::vector<std::string> cells = {
            row.method.family == family ? "" : row.method.family, row.method.name,
            method_time_text(row),
            row.method.takes_time() ? fmt::format("{:.1f}", row.time_ratio) : "-"};
        add_figures(row.error, report.channels, cells);
        std::string remark = row.on_front ? "front" : "";
        if (!row.method.baseline.empty()) {
            remark += (remark.empty() ? "baseline: " : ", baseline: ") + row.method.baseline;
        }
        cells.push_back(std::move(remark));
        table.add_row(std::move(cells));
        family = row.method.family;
    }
    std::vector<std::string> noise = {"truth's standard error", "", "", ""};
    add_figures(report.truth_error, report.channels, noise);
    table.add_row(std::move(noise));
    return fmt::format(
        "sky radiance against path tracing ({} directions, {} paths each on average)\n"
        "  error: of radiance, relative, in %: median, 90th percentile, largest; under each sun's "
        "zenith angle the RMS over the dome as a share of its mean\n"
        "  time: processor time of all that comes before the first view ray, one thread, median "
        "of {}; ratio to the cheapest\n"
        "  front: no other method has a smaller median in as little time (within 5 %)\n{}\n{}",
        report.directions, report.mean_paths, report.repetitions,
        report.black == 0
            ? ""
            : fmt::format("  {} values are left out, because they are black in the reference\n",
                          report.black),
        table.text() + ladder_text(report.ladder));
}

}  // namespace

ExitCode report_truth(const Invocation& invocation, Console& console) {
    const auto request = request_of(invocation);
    if (const ExitCode code = console.report(request.diagnostics); !request.value) return code;
    const auto problems = check_folder(*request.value, invocation[options::force]);
    if (!problems.empty()) return console.report(problems);
    Truth truth;
    if (const ExitCode code = find_truth(*request.value, truth, console); code != ExitCode::done) {
        return code;
    }
    const int repetitions = request.value->quick ? 1 : kRepetitions;
    auto methods = [&] {
        BakeProgress progress("sky", console);
        return make_sky_methods(sky_methods(request.value->medium, request.value->quick),
                                repetitions, &progress);
    }();
    if (!methods) return ExitCode::interrupted;
    SkyErrorReport report = measure_sky_errors(request.value->medium, *methods, truth, repetitions,
                                               request.value->threads);
    report.mean_paths = request.value->mean_paths;
    report.ladder = error_ladder(request.value->recipe.parameters, method_errors(report),
                                 {.threads = request.value->threads});
    const std::string csv = sky_truth_report_csv(report);
    const std::string json = sky_truth_report_json(report);
    std::vector<ReportFile> files = {{"sky_error.csv", csv},
                                     {kJsonName, json},
                                     {"sky_error.svg", report_svg(sky_truth_figure(report))}};
    if (const ExitCode code = add_pictures(*request.value, *methods, files, console);
        code != ExitCode::done) {
        return code;
    }
    if (interrupted()) return ExitCode::interrupted;
    if (const ExitCode code = write_report_files(files, request.value->folder, console);
        code != ExitCode::done) {
        return code;
    }
    console.result(invocation[options::json]  ? json
                   : invocation[options::csv] ? csv
                                              : sky_truth_table(report));
    return ExitCode::done;
}

}  // namespace skybake::cli
