// skybake sweep: bakes one recipe with many values.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "bakers/io/files/file_io.h"
#include "bakers/io/files/stopwatch.h"
#include "bakers/io/manifest/manifest.h"
#include "bakers/workspace/http_cache.h"
#include "bakers/workspace/sweep/index_files.h"
#include "bakers/workspace/sweep/run_sweep.h"
#include "bakers/workspace/sweep/variants.h"
#include "cli/command.h"
#include "cli/console.h"
#include "cli/options.h"
#include "cli/sweep.h"
#include "cli/table_printer.h"
#include "config/diagnostics/diagnostic_codes.h"
#include "config/recipe/recipe.h"

namespace skybake::cli {

Outcome<int> options::read_tasks(const std::string& text) {
    const auto tasks = parse_count(text, 1, config::most_variants);
    if (tasks) return {tasks, {}};
    return bad_value("--tasks", text,
                     fmt::format("it takes a number from 1 to {}", config::most_variants));
}

Outcome<std::pair<int, int>> options::read_shard(const std::string& text) {
    const std::size_t slash = std::min(text.find('/'), text.size());
    const std::string_view view = text;
    const auto shard = parse_count(view.substr(0, slash), 1, config::most_variants);
    const auto shards =
        parse_count(view.substr(std::min(slash + 1, text.size())), 1, config::most_variants);
    if (shard && shards && *shard <= *shards) return {std::pair(*shard, *shards), {}};
    return bad_value("--shard", text, "it takes I/N, which is part I of N, from 1/N to N/N");
}

namespace {

namespace fs = std::filesystem;

// Every variant reads the recipe again. A pipe cannot be read twice: opening it a second time would
// wait.
std::vector<Diagnostic> check_rereadable(const fs::path& recipe) {
    if (is_standard_input(recipe.string())) {
        return {usage_error(
            "a sweep reads its recipe more than once, which standard input does not allow",
            "write the recipe into a file")};
    }
    if (auto diagnostic = preset_in_place_of_file(recipe)) return {std::move(*diagnostic)};
    std::error_code error;
    const fs::file_status status = fs::status(recipe, error);
    if (!fs::exists(status) || fs::is_regular_file(status) || fs::is_directory(status)) return {};
    return {file_error("E0300", recipe.string(),
                       fmt::format("cannot read `{}`: it is not a regular file, and a sweep reads "
                                   "its recipe more than once",
                                   recipe.string()))};
}

Outcome<config::Sweep> sweep_of(const Invocation& invocation) {
    auto obstacles = check_rereadable(invocation.arguments()[0]);
    if (!obstacles.empty()) return {{}, std::move(obstacles)};
    const config::SweepOptions given = {.vary = invocation[options::vary],
                                        .zip = invocation[options::zip],
                                        .sobol = invocation.given(options::sobol)};
    auto sweep = config::load_sweep(invocation.arguments()[0], invocation[options::set], given);
    if (!sweep.value || !sweep.value->axes.empty()) return sweep;
    return usage_error("there is nothing to vary: add [sweep] to the recipe or pass --vary",
                       "for example --vary clouds.cumulus.cover=0.2:0.8:4");
}

std::vector<Diagnostic> contradictions(const Invocation& invocation) {
    std::vector<std::string_view> given;
    if (invocation.has(options::shard)) given.emplace_back("--shard");
    if (invocation.has(options::merge)) given.emplace_back("--merge");
    if (invocation.has(options::emit)) given.emplace_back("--emit");
    if (given.size() < 2) return {};
    return {usage_error(fmt::format("{} and {} exclude each other", given[0], given[1]))};
}

// Translates the options of the command line into a sweep.
SweepJob sweep_job(const Invocation& invocation, config::Sweep sweep) {
    SweepJob job;
    job.recipe = invocation.arguments()[0];
    job.settings = invocation[options::set];
    job.sweep = std::move(sweep);
    job.folder = invocation[options::output];
    if (invocation.has(options::shard)) {
        std::tie(job.shard, job.shards) = invocation[options::shard];
    }
    job.threads = invocation[options::jobs];
    job.certification = invocation[options::certify];
    job.force = invocation[options::force];
    job.memory_limit_mib = invocation.given(options::max_memory);
    return job;
}

// --- Baking -------------------------------------------------------------------------------------

// Reports each warning once, even if several variants give it: warnings are the same if their texts
// and their places in the recipe are the same. A warning of one variant alone names it.
void report_warnings(const std::vector<VariantResult>& results, Console& console) {
    using Text = std::tuple<std::string, std::string, std::string, int, int>;
    std::map<Text, std::size_t> known;
    std::vector<Diagnostic> warnings;
    std::vector<std::string> variants;  // of each warning; empty: several
    for (const VariantResult& result : results) {
        for (const Diagnostic& diagnostic : result.diagnostics) {
            if (diagnostic.severity != Severity::warning) continue;
            const config::SourceRange& where = diagnostic.where;
            const auto [at, is_new] = known.try_emplace(
                {diagnostic.code, diagnostic.message, where.source, where.line, where.column},
                warnings.size());
            if (!is_new) {
                variants[at->second].clear();
                continue;
            }
            warnings.push_back(diagnostic);
            variants.push_back(results.size() > 1 ? result.name + ": " : "");
        }
    }
    for (std::size_t i = 0; i < warnings.size(); ++i) warnings[i].message.insert(0, variants[i]);
    console.report(warnings);
}

// Reports what went wrong with each variant, and at the end that something did.
ExitCode report_unfinished(const std::vector<VariantResult>& results, Console& console) {
    constexpr int most_shown = 20;
    int shown = 0;
    for (const VariantResult& result : results) {
        if (result.status != VariantStatus::failed || ++shown > most_shown) continue;
        console.note(fmt::format("{}:\n", result.name));
        std::vector<Diagnostic> errors = result.diagnostics;
        std::erase_if(errors, [](const Diagnostic& diagnostic) {
            return diagnostic.severity == Severity::warning;
        });
        console.report(errors);
    }
    return console.report(unfinished(results));
}

// Whether no variant could even be planned. Then the recipe or the folder is at fault, not the
// variants.
bool all_failed(const std::vector<PlannedVariant>& plan) {
    return !plan.empty() && std::ranges::all_of(plan, [](const PlannedVariant& one) {
        return one.result.status == VariantStatus::failed;
    });
}

std::string paths_text(const SweepJob& job, const std::vector<VariantResult>& results) {
    std::string text;
    for (const VariantResult& result : results) {
        if (result.status != VariantStatus::done) continue;
        const fs::path folder = job.folder / result.name;
        for (const VariantAsset& asset : result.assets) {
            for (const std::string& file : asset.files) text += (folder / file).string() + "\n";
        }
        text += (folder / manifest_name).string() + "\n";
    }
    return text;
}

std::string index_paths_text(const SweepJob& job) {
    std::string text;
    for (const std::string_view name : index_names) text += (job.folder / name).string() + "\n";
    return text;
}

std::vector<VariantResult> make(const SweepJob& job, std::vector<PlannedVariant> plan, bool merge,
                                SweepReporter& reporter) {
    if (merge) return survey_sweep(job, std::move(plan));
    auto results = run_sweep(job, std::move(plan), reporter);
    reporter.finish();
    return results;
}

ExitCode dry_run(const SweepJob& job, const std::vector<PlannedVariant>& plan, Console& console) {
    console.result(console.json() ? sweep_event(job, plan) + planned_variant_events(job, plan)
                                  : plan_table(plan));
    console.note(plan_note(job, plan) + intermediates_note(plan));
    std::vector<VariantResult> failed;
    for (const PlannedVariant& variant : plan) {
        failed.push_back(variant.result);
        if (variant.to_be_made()) failed.back().status = VariantStatus::done;
    }
    return console.report(unfinished(failed));
}

// Says what an interrupted sweep has written. Each variant is written completely or not at all.
std::string interrupted_text(int made) {
    if (made == 0) return "interrupted; nothing was written\n";
    return fmt::format("interrupted; {} {} written, and the next run continues from there\n", made,
                       made == 1 ? "variant was" : "variants were");
}

ExitCode sweep(const Invocation& invocation, const SweepJob& job, Console& console) {
    const Stopwatch stopwatch;
    const bool merge = invocation[options::merge];
    const bool writes_index = job.shards == 1;
    const auto obstacles = inspect_index(job.folder, job.force);
    if (const ExitCode code = console.report(obstacles); code != ExitCode::done) return code;
    std::vector<PlannedVariant> plan = plan_sweep(job, interrupted);
    if (interrupted()) {
        console.note("interrupted; nothing was written\n");
        return ExitCode::interrupted;
    }
    if (writes_index && all_failed(plan)) return console.report(plan[0].result.diagnostics);
    if (invocation[options::dry_run]) return dry_run(job, plan, console);
    if (console.json()) console.result(sweep_event(job, plan));
    if (!merge) console.note(plan_note(job, plan));

    SweepReporter reporter(job, plan.size(), console);
    const std::vector<VariantResult> results = make(job, std::move(plan), merge, reporter);
    if (interrupted()) {
        console.note(interrupted_text(reporter.made()));
        return ExitCode::interrupted;
    }
    if (writes_index) {
        const auto failures = write_index(job.folder, job.sweep, results);
        if (!failures.empty()) return console.report(failures);
    }
    if (console.json()) {
        console.result(swept_event(results, reporter.made(), stopwatch.seconds()));
    } else {
        console.result(paths_text(job, results) + (writes_index ? index_paths_text(job) : ""));
    }
    report_warnings(results, console);
    console.note(fmt::format("{} baked, {}\n",
                             counted(static_cast<std::size_t>(reporter.made()), "variant"),
                             time_text(stopwatch.seconds())));
    if (writes_index) console.note(earlier_note(folders_of_earlier_sweeps(job)));
    return report_unfinished(results, console);
}

ExitCode run_sweep(const Invocation& invocation, Console& console) {
    if (const ExitCode code = console.report(contradictions(invocation)); code != ExitCode::done) {
        return code;
    }
    auto found = sweep_of(invocation);
    if (const ExitCode code = console.report(found.diagnostics); !found.value) return code;
    SweepJob job = sweep_job(invocation, std::move(*found.value));
    const auto cache = cache_folder(invocation);
    if (!cache.value) return console.report(cache.diagnostics);
    job.cache = *cache.value;
    if (invocation.has(options::emit)) return emit_tasks(invocation, job, console);
    const auto url = cache_url(invocation);
    if (!url.value) return console.report(url.diagnostics);
    std::optional<HttpCache> server;
    if (!url.value->empty()) job.server = &server.emplace(*url.value, interrupted);
    const ExitCode code = sweep(invocation, job, console);
    if (server) console.report(server->problems());
    return code;
}

}  // namespace

Command sweep_command() {
    return {
        .name = "sweep",
        .brief = "bake many variants",
        .summary = "bake variants of a recipe, one folder for each, and an index of them",
        .arguments = {{.name = "recipe.toml",
                       .help = "the recipe, whose [sweep] says what varies"}},
        .options = {options::output("write the variants' folders into this folder", "sweep"),
                    options::vary("vary KEY over FROM:TO:COUNT[:log] or A,B,C instead of [sweep]"),
                    options::zip("vary keys in lockstep instead of crossing them"),
                    options::sobol("spread N points over ranges without a count"), set_row(),
                    options::shard("bake part I of N and leave out the index"),
                    options::merge("write the index of baked variants without baking"),
                    options::emit("print the commands of a farm's tasks, one per line"),
                    options::tasks(
                        "split the sweep into N tasks (default: one per variant, up to 1000)"),
                    certify_row(),
                    options::jobs("use N threads, for variants side by side first (default: all)"),
                    options::dry_run("show which variants would be baked and why, without baking"),
                    cache_row(), server_row(),
                    options::max_memory("limit the memory of all variants at once (2GiB, 500M)"),
                    options::force("overwrite files that skybake did not write")},
        .examples = {{"skybake sweep clouds.toml --vary clouds.cumulus.cover=0.2:0.8:4 --vary "
                      "clouds.cumulus.convection.seed=1,2",
                      "bakes 8 variants"},
                     {"skybake sweep sky.toml --shard 1/2", "bakes half of the variants"},
                     {"skybake sweep sky.toml --emit commands | parallel",
                      "bakes variants side by side, by another program"}},
        .exit_codes = {ExitCode::io, ExitCode::checks},
        .run = run_sweep};
}

}  // namespace skybake::cli
