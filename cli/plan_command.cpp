// skybake plan: measures the ways to draw the light and the clouds of a recipe, and writes the recipe of
// the best ones.
#include "bakers/plan/plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <variant>
#include <vector>

#include "bakers/assets/description/certificate_warnings.h"
#include "bakers/io/files/file_io.h"
#include "bakers/io/files/to_string.h"
#include "bakers/plan/plan_files.h"
#include "bakers/plot/drawing.h"
#include "bakers/preview/page.h"
#include "cli/command.h"
#include "cli/console.h"
#include "cli/options.h"
#include "cli/plan_page.h"
#include "cli/progress.h"
#include "cli/report.h"
#include "cli/table_printer.h"
#include "config/text/units.h"

namespace skybake::cli {

namespace options {
namespace {

Outcome<double> read_share(const std::string& text, std::string_view option) {
    const auto read = config::parse_quantity(text);
    const auto* share = std::get_if<config::Quantity>(&read);
    const bool is_share = share != nullptr && (share->dimension == config::Dimension::number ||
                                               share->dimension == config::Dimension::fraction);
    if (is_share && share->value > 0 && share->value <= 1) return {share->value, {}};
    return bad_value(std::string(option), text, "it takes a share up to 1, such as 2% or 0.02");
}

Outcome<double> read_fetches(const std::string& text) {
    if (const auto count = parse_count(text, 1, 1'000'000)) return {count, {}};
    return bad_value("--max-fetches", text, "it takes a number from 1 to 1000000");
}

Outcome<double> read_size(const std::string& text) {
    const auto bytes = parse_byte_size(text);
    constexpr std::uint64_t fewest = 1024;
    if (bytes && *bytes >= fewest) return {static_cast<double>(*bytes), {}};
    return bad_value("--max-size", text, fmt::format("{}, of 1 KiB at least", byte_size_words));
}

const Option<double> max_sky_error{"max-sky-error", 0, "SHARE", {}, [](const std::string& text) {
                                       return read_share(text, "--max-sky-error");
                                   }};
const Option<double> max_cloud_error{
    "max-cloud-error", 0, "SHARE", {}, [](const std::string& text) {
        return read_share(text, "--max-cloud-error");
    }};
const Option<double> max_fetches{"max-fetches", 0, "N", {}, read_fetches};
const Option<double> max_size{"max-size", 0, "SIZE", {}, read_size};
const Option<std::filesystem::path> write{"write", 0, "FILE"};

}  // namespace
}  // namespace options

namespace {

WayLimits limits_of(const Invocation& invocation, const PlanSubject& subject) {
    return {
        invocation.given(subject.is_cloud() ? options::max_cloud_error : options::max_sky_error),
        invocation.given(options::max_fetches), invocation.given(options::max_size)};
}

// Returns the front, and the least error of each baseline that has no way on it.
std::vector<std::size_t> shown_ways(const Plan& plan) {
    std::set<std::string_view> baselines;
    for (const MeasuredWay& way : plan.ways) {
        if (way.on_front) baselines.insert(way.way.baseline);
    }
    std::vector<std::size_t> shown = by_error(plan.ways);
    std::erase_if(shown, [&](std::size_t i) {
        const auto& [way, error, figures, bake_s, on_front] = plan.ways[i];
        return !on_front && (way.baseline.empty() || !baselines.insert(way.baseline).second);
    });
    return shown;
}

std::string table_text(const Plan& plan) {
    TextTable table({Align::left, Align::left, Align::right, Align::right, Align::right,
                     Align::right, Align::right, Align::right, Align::right, Align::left});
    table.add_row({"way", "", "median %", plan.words.column, "max %", "fetches", "operations",
                   "textures", "bake", ""});
    for (const std::size_t i : shown_ways(plan)) {
        const MeasuredWay& way = plan.ways[i];
        table.add_row(
            {way.way.family, way.way.name, fmt::format("{}", to_percent(way.error.median)),
             fmt::format("{}", to_percent(way.figures.error)),
             fmt::format("{}", to_percent(way.error.max)),
             fmt::format("{:.0f}", way.figures.fetches),
             fmt::format("{:.0f}", way.figures.operations), byte_size_text(way.figures.bytes),
             time_text(way.bake_s), remark_of(plan, i)});
    }
    std::string text = fmt::format(
        "{} from {}\n"
        "  error: {}\n"
        "  paths: {}; their standard error is {} %\n"
        "  fetches: of a mean pixel; operations: of their lookups, divisions and roots as four;\n"
        "  textures: in memory; bake: wall time, here, on all cores\n"
        "  front: no other way is as good in error, fetches, operations and size\n"
        "  knee: the least error x root of fetches x fourth root of bytes\n\n",
        name_of(plan.subject), plan.scene, plan.words.meaning, plan.reference,
        to_percent(plan.ways.front().error.standard_error));
    text += table.text();
    for (const std::string& note : plan.notes) text += fmt::format("  {}\n", note);
    return text + fmt::format("\n  {} of {} ways; plan.csv has all\n", shown_ways(plan).size(),
                              plan.ways.size());
}

// A plan's files carry the sign of a report, which guards what others have written.
Outcome<std::vector<NamedFile>> files_of(const std::vector<Plan>& plans, const std::string& title) {
    auto page = plan_page(plans, title);
    if (!page.value) return {{}, std::move(page.diagnostics)};
    std::vector<NamedFile> files = {{"plan.csv", plan_csv(plans)},
                                    {"plan.json", plan_json(plans)},
                                    {page_name, std::move(*page.value)}};
    for (const Plan& plan : plans) {
        files.push_back({file_name_of(plan.subject) + ".svg", report_svg(plan_figure(plan))});
        if (plan.sheet.empty()) continue;
        files.push_back({file_name_of(plan.subject) + ".png", plan.sheet});
    }
    return {std::move(files), {}};
}

std::vector<std::string> file_names_of(const std::vector<PlanSubject>& subjects) {
    std::vector<std::string> names = {"plan.csv", "plan.json", page_name};
    for (const PlanSubject& subject : subjects) {
        names.push_back(file_name_of(subject) + ".svg");
        names.push_back(file_name_of(subject) + ".png");
    }
    return names;
}

// Returns E0303 if the recipe is to be written over a file.
std::optional<Diagnostic> existing_recipe(const Invocation& invocation) {
    std::error_code error;
    const std::filesystem::path path = invocation[options::write];
    if (path.empty() || invocation[options::force] || !std::filesystem::exists(path, error)) {
        return std::nullopt;
    }
    return file_error("E0303", path.string(), fmt::format("`{}` already exists", path.string()),
                      "overwrite it with --force, or choose another name");
}

ExitCode write_recipe(const std::vector<Plan>& plans, const Recipe& recipe,
                      const std::filesystem::path& path, Console& console) {
    std::filesystem::path folder = path.parent_path();
    if (folder.empty()) folder = ".";
    return write_report_files({{path.filename().string(), planned_recipe(plans, recipe)}}, folder,
                              console);
}

Outcome<Plan> plan_subject(const Invocation& invocation, const std::filesystem::path& cache,
                           const PlanSubject& subject, Console& console) {
    BakeProgress progress(word_of(subject), console);
    PlanRequest request;
    request.load = [&](std::span<const std::string> settings) {
        return recipe_of(invocation, settings);
    };
    request.cache = cache;
    request.limits = limits_of(invocation, subject);
    request.threads = invocation[options::jobs];
    request.progress = &progress;
    Outcome<Plan> plan = subject.is_cloud() ? plan_cloud(request, subject.cloud)
                                            : plan_light(request, subject.draws);
    for (Diagnostic& found : plan.diagnostics) {
        if (found.where.source.empty()) {
            found.where.source = recipe_name(invocation.arguments()[0]);
        }
    }
    return plan;
}

// Returns all that forbids a plan before any work is done.
std::vector<Diagnostic> obstacles(const Invocation& invocation,
                                  const std::vector<PlanSubject>& subjects) {
    if (invocation[options::json] && invocation[options::csv]) {
        return {
            usage_error("--json and --csv exclude each other", "the folder gets both in any case")};
    }
    if (subjects.empty()) {
        return {file_error(
            "E0105", recipe_name(invocation.arguments()[0]),
            "the recipe has neither an [atmosphere] nor [clouds.NAME] that its scene draws")};
    }
    auto problems = check_report_folder(invocation[options::output], file_names_of(subjects),
                                        invocation[options::force]);
    if (!problems.empty()) return problems;
    if (auto problem = existing_recipe(invocation)) return {*std::move(problem)};
    if (auto problem = chart_problem()) return {*std::move(problem)};
    return {};
}

std::string result_text(const Invocation& invocation, const std::vector<Plan>& plans) {
    if (invocation[options::json]) return plan_json(plans);
    if (invocation[options::csv]) return plan_csv(plans);
    std::string text;
    for (const Plan& plan : plans) text += (text.empty() ? "" : "\n") + table_text(plan);
    return text;
}

ExitCode run_plan(const Invocation& invocation, Console& console) {
    auto cache = cache_folder(invocation);
    if (!cache.value) return console.report(cache.diagnostics);
    const auto recipe = recipe_of(invocation);
    if (const ExitCode code = console.report(recipe.diagnostics); !recipe.value) return code;
    const std::vector<PlanSubject> subjects = subjects_of(recipe.value->parameters);
    const auto problems = obstacles(invocation, subjects);
    if (const ExitCode code = console.report(problems); code != ExitCode::done) return code;
    std::vector<Plan> plans;
    ExitCode outcome = ExitCode::done;
    for (const PlanSubject& subject : subjects) {
        auto plan = plan_subject(invocation, *cache.value, subject, console);
        if (interrupted()) return ExitCode::interrupted;
        const ExitCode code = console.report(plan.diagnostics);
        if (!plan.value) return code;
        if (outcome == ExitCode::done) outcome = code;
        plans.push_back(std::move(*plan.value));
    }
    const auto files = files_of(plans, recipe_name(invocation.arguments()[0]));
    if (!files.value) return console.report(files.diagnostics);
    ExitCode code = write_report_files(*files.value, invocation[options::output], console);
    if (code == ExitCode::done && outcome == ExitCode::done && invocation.has(options::write)) {
        code = write_recipe(plans, *recipe.value, invocation[options::write], console);
    }
    if (code != ExitCode::done) return code;
    console.result(result_text(invocation, plans));
    return outcome;
}

}  // namespace

Command plan_command() {
    return {
        .name = "plan",
        .brief = "choose what a scene needs",
        .summary =
            "measure the ways to draw a recipe's sky and clouds, and choose by error, fetches and "
            "size",
        .arguments = {{.name = "recipe.toml", .help = recipe_help}},
        .options = {options::output(
                        "write index.html, plan.csv, .json and pictures into this folder", "plan"),
                    set_row(),
                    options::max_sky_error(
                        "choose among ways with at most this error in nine of "
                        "ten views of the sky, or of what else the air's light is"),
                    options::max_cloud_error("choose among ways with at most this RMS error of a "
                                             "cloud's picture, in shares of white"),
                    options::max_fetches("choose among ways with at most N fetches per pixel"),
                    options::max_size("choose among ways whose textures take at most this (2MiB)"),
                    options::write("write the recipe of the chosen ways"), cache_row(),
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
