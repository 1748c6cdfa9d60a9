// skybake plan: measures the ways to draw the sky of a recipe, and writes the recipe of the best one.
#include "bakers/plan/plan_sky.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "bakers/assets/description/certificate_warnings.h"
#include "bakers/io/files/file_io.h"
#include "bakers/io/files/to_string.h"
#include "bakers/plan/plan_files.h"
#include "bakers/plot/drawing.h"
#include "cli/command.h"
#include "cli/console.h"
#include "cli/options.h"
#include "cli/progress.h"
#include "cli/report.h"
#include "cli/table_printer.h"

namespace skybake::cli {

using config::Outcome;

namespace options {
namespace {

Outcome<double> read_share(const std::string& text) {
    double number = 0;
    const char* const end = text.data() + text.size();
    const auto [after, error] = std::from_chars(text.data(), end, number, std::chars_format::fixed);
    const std::string_view unit(after, static_cast<std::size_t>(end - after));
    const double share = unit.empty() ? number : number / 100;
    const bool has_unit = unit.empty() || unit == "%" || unit == " %";
    if (error == std::errc{} && has_unit && share > 0 && share <= 1) return {share, {}};
    return {{},
            {bad_value("--max-sky-error", text, "it takes a share up to 1, such as 2% or 0.02")}};
}

Outcome<std::int64_t> read_fetches(const std::string& text) {
    if (const auto count = parse_count(text, 1, 1'000'000)) return {*count, {}};
    return {{}, {bad_value("--max-fetches", text, "it takes a number from 1 to 1000000")}};
}

Outcome<std::uint64_t> read_size(const std::string& text) {
    const auto bytes = parse_byte_size(text);
    constexpr std::uint64_t fewest = 1024;
    if (bytes && *bytes >= fewest) return {*bytes, {}};
    return {{},
            {bad_value("--max-size", text, fmt::format("{}, of 1 KiB at least", byte_size_words))}};
}

const Option<double> max_sky_error{"max-sky-error", 0, "SHARE", {}, read_share};
const Option<std::int64_t> max_fetches{"max-fetches", 0, "N", {}, read_fetches};
const Option<std::uint64_t> max_size{"max-size", 0, "SIZE", {}, read_size};
const Option<std::filesystem::path> write{"write", 0, "FILE"};

}  // namespace
}  // namespace options

namespace {

WayLimits limits_of(const Invocation& invocation) {
    WayLimits limits;
    if (invocation.has(options::max_sky_error)) limits.error = invocation[options::max_sky_error];
    if (invocation.has(options::max_fetches)) {
        limits.fetches = static_cast<double>(invocation[options::max_fetches]);
    }
    if (invocation.has(options::max_size)) {
        limits.bytes = static_cast<double>(invocation[options::max_size]);
    }
    return limits;
}

// Returns the front, and the least error of each baseline that has no way on it.
std::vector<std::size_t> shown_ways(const SkyPlan& plan) {
    std::vector<std::size_t> shown = front_by_error(plan);
    std::map<std::string_view, std::size_t> baselines;
    for (std::size_t i = 0; i < plan.ways.size(); ++i) {
        const MeasuredWay& way = plan.ways[i];
        if (way.way.baseline.empty()) continue;
        const auto [best, is_first] = baselines.try_emplace(way.way.baseline, i);
        const MeasuredWay& other = plan.ways[best->second];
        const bool is_better = !other.on_front && way.figures.error < other.figures.error;
        if (way.on_front || is_better) best->second = i;
    }
    for (const auto& [name, best] : baselines) {
        if (!plan.ways[best].on_front) shown.push_back(best);
    }
    std::stable_sort(shown.begin(), shown.end(), [&](std::size_t a, std::size_t b) {
        return plan.ways[a].figures.error < plan.ways[b].figures.error;
    });
    return shown;
}

std::string remark_of(const SkyPlan& plan, std::size_t index) {
    const MeasuredWay& way = plan.ways[index];
    std::string remark = way.on_front ? "front" : "";
    if (index == plan.knee) remark = "knee";
    if (index == plan.chosen) remark = plan.keeps_limits ? "chosen" : "least error";
    if (way.way.baseline.empty()) return remark;
    return fmt::format("{}{}baseline: {}", remark, remark.empty() ? "" : ", ", way.way.baseline);
}

std::string table_text(const SkyPlan& plan) {
    TextTable table({Align::left, Align::left, Align::right, Align::right, Align::right,
                     Align::right, Align::right, Align::right, Align::left});
    table.add_row({"way", "", "median %", "9 in 10 %", "max %", "fetches", "textures", "bake", ""});
    for (const std::size_t i : shown_ways(plan)) {
        const MeasuredWay& way = plan.ways[i];
        table.add_row(
            {way.way.family, way.way.name, fmt::format("{}", to_percent(way.error.median)),
             fmt::format("{}", to_percent(way.error.ninth_decile)),
             fmt::format("{}", to_percent(way.error.max)),
             fmt::format("{:.0f}", way.figures.fetches), byte_size_text(way.figures.bytes),
             time_text(way.bake_s), remark_of(plan, i)});
    }
    std::string text = fmt::format(
        "the sky of {}\n"
        "  error: of {} against paths of light, in the median, in nine of ten views, and the "
        "largest\n"
        "  paths: {}; their standard error is {} %\n"
        "  fetches: of a pixel of the sky; textures: in memory; bake: wall time, here, on all "
        "cores\n"
        "  front: no other way is as good in error, fetches and size\n"
        "  knee: the least error x root of fetches x fourth root of bytes\n\n",
        views_text(plan), plan.has_colors ? "colours" : "radiance", plan.reference,
        to_percent(plan.ways.front().error.standard_error));
    text += table.text();
    for (const std::string& note : plan.notes) text += fmt::format("  {}\n", note);
    return text + fmt::format("\n  {} of {} ways; plan.csv has all\n", shown_ways(plan).size(),
                              plan.ways.size());
}

// A plan's files carry the sign of a report, which guards what others have written.
std::vector<ReportFile> files_of(const SkyPlan& plan) {
    return {{"plan.csv", plan_csv(plan)},
            {"plan.json", plan_json(plan)},
            {"plan.svg", report_svg(plan_figure(plan))},
            {"plan.png", plan.sheet}};
}

// Returns E0303 if the recipe is to be written over a file.
std::optional<config::Diagnostic> existing_recipe(const Invocation& invocation) {
    std::error_code error;
    const std::filesystem::path path = invocation[options::write];
    if (path.empty() || invocation[options::force] || !std::filesystem::exists(path, error)) {
        return std::nullopt;
    }
    config::Diagnostic problem =
        file_error("E0303", path.string(), fmt::format("`{}` already exists", path.string()));
    problem.label = "overwrite it with --force, or choose another name";
    return problem;
}

ExitCode write_recipe(const SkyPlan& plan, const config::Recipe& recipe,
                      const std::filesystem::path& path, Console& console) {
    std::filesystem::path folder = path.parent_path();
    if (folder.empty()) folder = ".";
    return write_report_files({{path.filename().string(), planned_recipe(plan, recipe)}}, folder,
                              console);
}

ExitCode run_plan(const Invocation& invocation, Console& console) {
    if (invocation[options::json] && invocation[options::csv]) {
        return console.report(std::array{usage_error("--json and --csv exclude each other",
                                                     "the folder gets both in any case")});
    }
    const std::filesystem::path folder = invocation[options::output];
    const bool force = invocation[options::force];
    const auto problems =
        check_report_folder(folder, {"plan.csv", "plan.json", "plan.svg", "plan.png"}, force);
    if (!problems.empty()) return console.report(problems);
    if (const auto problem = existing_recipe(invocation))
        return console.report(std::array{*problem});
    if (const auto problem = chart_problem()) {
        const ExitCode code = console.report(std::array{*problem});
        if (code != ExitCode::done) return code;
    }
    auto cache = cache_folder(invocation);
    if (!cache.value) return console.report(cache.diagnostics);
    auto recipe = recipe_of(invocation);
    if (const ExitCode code = console.report(recipe.diagnostics); !recipe.value) return code;
    auto plan = [&] {
        BakeProgress progress("sky", console);
        PlanRequest request;
        request.load = [&](std::span<const std::string> settings) {
            return recipe_of(invocation, settings);
        };
        request.cache = *cache.value;
        request.limits = limits_of(invocation);
        request.threads = invocation[options::jobs];
        request.progress = &progress;
        return plan_sky(request);
    }();
    if (interrupted()) return ExitCode::interrupted;
    for (config::Diagnostic& found : plan.diagnostics) {
        if (found.where.source.empty()) {
            found.where.source = recipe_name(invocation.arguments()[0]);
        }
    }
    const ExitCode outcome = console.report(plan.diagnostics);
    if (!plan.value) return outcome;
    ExitCode code = write_report_files(files_of(*plan.value), folder, console);
    if (code == ExitCode::done && outcome == ExitCode::done && invocation.has(options::write)) {
        code = write_recipe(*plan.value, *recipe.value, invocation[options::write], console);
    }
    if (code != ExitCode::done) return code;
    console.result(invocation[options::json]  ? plan_json(*plan.value)
                   : invocation[options::csv] ? plan_csv(*plan.value)
                                              : table_text(*plan.value));
    return outcome;
}

}  // namespace

Command plan_command() {
    return {
        .name = "plan",
        .brief = "choose what the sky needs",
        .summary = "measure the ways to draw a recipe's sky, and choose by error, fetches and size",
        .arguments = {{.name = "recipe.toml", .help = recipe_help}},
        .options = {options::output("write plan.csv, .json, .svg and .png into this folder",
                                    "plan"),
                    set_row(),
                    options::max_sky_error("choose among ways with at most this error in nine of "
                                           "ten views"),
                    options::max_fetches("choose among ways with at most N fetches per pixel"),
                    options::max_size("choose among ways whose textures take at most this (2MiB)"),
                    options::write("write the recipe of the chosen way"), cache_row(),
                    options::jobs("use N threads (default: all)"),
                    options::force("overwrite files that no plan has written"),
                    options::csv("print CSV instead of the table (--json: plan.json)")},
        .examples = {{"skybake plan earth.toml", "shows what each way costs, and the best"},
                     {"skybake plan earth.toml --max-sky-error 2% --write sky.toml",
                      "writes the recipe of the way with the fewest fetches"}},
        .exit_codes = {ExitCode::io, ExitCode::checks},
        .run = run_plan};
}

}  // namespace skybake::cli
