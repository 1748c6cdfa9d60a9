// skybake sweep: one recipe, many values.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <chrono>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "bakers/io/files/file_diagnostic.h"
#include "bakers/io/files/load_module.h"
#include "bakers/io/manifest/manifest.h"
#include "bakers/workspace/sweep/index_files.h"
#include "bakers/workspace/sweep/run_sweep.h"
#include "bakers/workspace/sweep/variant_names.h"
#include "cli/bake_selection.h"
#include "cli/byte_size.h"
#include "cli/cache_folder.h"
#include "cli/command.h"
#include "cli/console.h"
#include "cli/event_line.h"
#include "cli/interrupt.h"
#include "cli/parse_arguments.h"
#include "cli/recipe_argument.h"
#include "cli/sweep_reporter.h"
#include "cli/sweep_scripts.h"
#include "config/diagnostics/diagnostic_codes.h"
#include "config/recipe/recipe.h"

namespace skybake::cli {
namespace {

namespace fs = std::filesystem;
using config::Diagnostic;
using config::Outcome;

// Every variant reads the recipe again, which a pipe cannot give twice: opening it would wait.
std::vector<Diagnostic> check_rereadable(const fs::path& recipe) {
    if (is_standard_input(recipe.string())) {
        return {
            usage_error("a sweep reads its recipe more than once, which standard input does not "
                        "allow",
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
    config::SweepOptions options;
    options.vary = invocation.values("vary");
    options.zip = invocation.values("zip");
    if (invocation.has("sobol")) options.sobol = invocation.value("sobol");
    auto sweep = config::load_sweep(invocation.arguments()[0], invocation.values("set"), options);
    if (!sweep.value || !sweep.value->axes.empty()) return sweep;
    return {{},
            {usage_error("there is nothing to vary: add [sweep] to the recipe or pass --vary",
                         "for example --vary clouds.cumulus.coverage=0.2:0.8:4")}};
}

// A whole number from 1 to 100000, the whole text.
std::optional<int> count_of(std::string_view text) {
    int count = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), count);
    const bool whole = error == std::errc() && end == text.data() + text.size();
    if (!whole || count < 1 || count > config::most_variants) return std::nullopt;
    return count;
}

Outcome<std::pair<int, int>> shard_of(const Invocation& invocation) {
    if (!invocation.has("shard")) return {std::pair(1, 1), {}};
    const std::string text = invocation.value("shard");
    const std::size_t slash = std::min(text.find('/'), text.size());
    const auto shard = count_of(std::string_view(text).substr(0, slash));
    const auto shards = count_of(std::string_view(text).substr(std::min(slash + 1, text.size())));
    if (shard && shards && *shard <= *shards) return {std::pair(*shard, *shards), {}};
    return {{},
            {usage_error(fmt::format("`--shard` cannot be `{}`", text),
                         "it takes I/N, which is part I of N, from 1/N to N/N")}};
}

std::vector<Diagnostic> contradictions(const Invocation& invocation) {
    constexpr std::array modes = {"shard", "merge", "emit"};
    std::vector<std::string> given;
    for (const char* mode : modes) {
        if (invocation.has(mode)) given.push_back(fmt::format("--{}", mode));
    }
    if (given.size() < 2) return {};
    return {usage_error(fmt::format("{} and {} exclude each other", given[0], given[1]))};
}

// What stands between the command line and a sweep.
Outcome<SweepJob> sweep_job(const Invocation& invocation, config::Sweep sweep) {
    SweepJob job;
    job.recipe = invocation.arguments()[0];
    job.settings = invocation.values("set");
    job.sweep = std::move(sweep);
    job.folder = invocation.value("output");
    if (job.folder.empty()) return {{}, {usage_error("-o: the folder's name is empty")}};
    const auto shard = shard_of(invocation);
    if (!shard.value) return {{}, shard.diagnostics};
    std::tie(job.shard, job.shards) = *shard.value;
    const auto threads = jobs_of(invocation);
    if (!threads.value) return {{}, threads.diagnostics};
    job.threads = *threads.value;
    const std::string certify = invocation.value("certify");
    if (certify == "off") job.certification = Certification::off;
    if (certify == "full") job.certification = Certification::full;
    job.force = invocation.has("force");
    job.cache = cache_folder(invocation);
    if (invocation.has("max-memory")) {
        const auto bytes = parse_byte_size(invocation.value("max-memory"));
        if (!bytes) return {{}, {byte_size_error("--max-memory", invocation.value("max-memory"))}};
        job.memory_limit_mib = static_cast<double>(*bytes) / (1024.0 * 1024.0);
    }
    return {std::move(job), {}};
}

// --- Scripts for farms --------------------------------------------------------------------------

// The program itself, so that a node finds it whatever its PATH.
std::string program_path() {
    const std::vector<fs::path> files = program_files();
    return files.empty() ? "skybake" : files.front().string();
}

// A farm starts its tasks in folders of its own.
std::string absolute_path(const std::string& path) { return fs::absolute(path).string(); }

std::vector<std::string> script_words(const Invocation& invocation) {
    std::vector<std::string> words = {program_path(), "sweep",
                                      absolute_path(invocation.arguments()[0])};
    for (const char* option : {"set", "vary", "zip"}) {
        for (const std::string& value : invocation.values(option)) {
            words.push_back(fmt::format("--{}", option));
            words.push_back(value);
        }
    }
    for (const char* option : {"sobol", "certify", "max-memory"}) {
        if (!invocation.has(option)) continue;
        words.push_back(fmt::format("--{}", option));
        words.push_back(invocation.value(option));
    }
    if (invocation.has("cache-dir")) {
        words.emplace_back("--cache-dir");
        words.push_back(absolute_path(invocation.value("cache-dir")));
    }
    if (invocation.has("force")) words.emplace_back("--force");
    words.emplace_back("-o");
    words.push_back(absolute_path(invocation.value("output")));
    return words;
}

// All files that any variant is made from, the program's among them.
std::vector<fs::path> sweep_inputs(const SweepJob& job) {
    std::vector<fs::path> inputs = program_files();
    std::set<fs::path> known;
    for (int i = 0; i < variant_count(job.sweep); ++i) {
        const auto recipe = config::load_variant(job.recipe, job.settings, job.sweep, i);
        if (!recipe.value) continue;
        for (const fs::path& input : recipe.value->inputs) {
            const fs::path path = fs::absolute(input);
            if (known.insert(path).second) inputs.push_back(path);
        }
    }
    return inputs;
}

// Slurm's own limit of an array job, MaxArraySize, is 1001 where nobody has raised it.
constexpr int most_tasks = 1000;

Outcome<SweepScript> sweep_script(const Invocation& invocation, const SweepJob& job) {
    SweepScript script;
    script.words = script_words(invocation);
    script.folder = absolute_path(job.folder.string());
    script.variants = variant_count(job.sweep);
    script.tasks = std::min(script.variants, most_tasks);
    script.threads = job.threads > 0 ? job.threads : 1;
    if (invocation.has("tasks")) {
        const auto tasks = count_of(invocation.value("tasks"));
        if (!tasks) {
            return {{},
                    {usage_error(
                        fmt::format("`--tasks` cannot be `{}`", invocation.value("tasks")),
                        fmt::format("it takes a number from 1 to {}", config::most_variants))}};
        }
        script.tasks = std::min(*tasks, script.variants);
    }
    for (const std::string& word : script.words) {
        if (word.find('\n') == std::string::npos) continue;
        return {{}, {usage_error("--emit: a value holds a line break, but a task is one line")}};
    }
    return {std::move(script), {}};
}

std::string script_text(const std::string& engine, const SweepJob& job, SweepScript script) {
    if (engine == "slurm") return slurm_script(script);
    if (engine == "commands") return command_lines(script);
    script.inputs = sweep_inputs(job);
    const VariantNames names(job.sweep);
    for (int i = 0; i < script.variants; ++i) script.names.push_back(names.name(i));
    return ninja_file(script);
}

ExitCode emit(const Invocation& invocation, const SweepJob& job, Console& console) {
    const auto script = sweep_script(invocation, job);
    if (const ExitCode code = console.report(script.diagnostics); !script.value) return code;
    const std::string engine = invocation.value("emit");
    const std::string text = script_text(engine, job, *script.value);
    const std::string merge = merge_command(*script.value);
    if (console.display().json) {
        console.result(event_line(
            {{"event", "script"}, {"engine", engine}, {"text", text}, {"merge", merge}}));
        return ExitCode::done;
    }
    console.result(text);
    if (engine == "commands") {
        console.note(fmt::format("when all are done, write the index: {}\n", merge));
    }
    return ExitCode::done;
}

// --- Baking -------------------------------------------------------------------------------------

// The same warning of many variants is one: the same words of the same place of the recipe.
void report_warnings(const std::vector<VariantResult>& results, Console& console) {
    std::set<std::tuple<std::string, std::string, std::string, int, int>> known;
    std::vector<Diagnostic> warnings;
    for (const VariantResult& result : results) {
        for (const Diagnostic& diagnostic : result.diagnostics) {
            if (diagnostic.severity != config::Severity::warning) continue;
            const config::SourceRange& where = diagnostic.where;
            if (known
                    .emplace(diagnostic.code, diagnostic.message, where.source, where.line,
                             where.column)
                    .second) {
                warnings.push_back(diagnostic);
            }
        }
    }
    console.report(warnings);
}

// What went wrong with each, and last that something did.
ExitCode report_unfinished(const std::vector<VariantResult>& results, Console& console) {
    constexpr int most_shown = 20;
    int shown = 0;
    for (const VariantResult& result : results) {
        if (result.status != VariantStatus::failed || ++shown > most_shown) continue;
        console.note(fmt::format("{}:\n", result.name));
        std::vector<Diagnostic> errors = result.diagnostics;
        std::erase_if(errors, [](const Diagnostic& diagnostic) {
            return diagnostic.severity == config::Severity::warning;
        });
        console.report(errors);
    }
    return console.report(unfinished(results));
}

// Where no variant can even be planned the fault is the recipe's or the folder's, not theirs.
bool all_failed(const std::vector<PlannedVariant>& plan) {
    return !plan.empty() && std::all_of(plan.begin(), plan.end(), [](const PlannedVariant& one) {
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

std::string variants_text(int count) {
    return fmt::format("{} variant{}", count, count == 1 ? "" : "s");
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

ExitCode dry_run(const SweepJob& job, const std::vector<PlannedVariant>& plan, bool json,
                 Console& console) {
    console.result(json ? sweep_event(job, plan) + planned_variant_events(job, plan)
                        : plan_table(plan));
    console.note(plan_note(job, plan));
    std::vector<VariantResult> failed;
    for (const PlannedVariant& variant : plan) {
        failed.push_back(variant.result);
        if (variant.to_be_made()) failed.back().status = VariantStatus::done;
    }
    return console.report(unfinished(failed));
}

// Variants are written whole, one by one.
std::string interrupted_text(int made) {
    if (made == 0) return "interrupted; nothing was written\n";
    return fmt::format("interrupted; {} {} written, and the next run continues from there\n", made,
                       made == 1 ? "variant was" : "variants were");
}

ExitCode sweep(const Invocation& invocation, const SweepJob& job, Console& console) {
    const auto start = std::chrono::steady_clock::now();
    const bool json = console.display().json;
    const bool merge = invocation.has("merge");
    const bool writes_index = job.shards == 1;
    if (writes_index) {
        const auto obstacles = inspect_index(job.folder, job.force);
        if (const ExitCode code = console.report(obstacles); code != ExitCode::done) return code;
    }
    std::vector<PlannedVariant> plan = plan_sweep(job, interrupted);
    if (interrupted()) {
        console.note("interrupted; nothing was written\n");
        return ExitCode::interrupted;
    }
    if (writes_index && all_failed(plan)) return console.report(plan[0].result.diagnostics);
    if (invocation.has("dry-run")) return dry_run(job, plan, json, console);
    if (json) console.result(sweep_event(job, plan));
    if (!merge) console.note(plan_note(job, plan));

    SweepReporter reporter(job, plan.size(), console, json);
    const std::vector<VariantResult> results = make(job, std::move(plan), merge, reporter);
    if (interrupted()) {
        console.note(interrupted_text(reporter.made()));
        return ExitCode::interrupted;
    }
    if (writes_index) {
        const auto failures = write_index(job.folder, job.sweep, results);
        if (!failures.empty()) return console.report(failures);
    }
    const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
    if (json) {
        console.result(swept_event(results, reporter.made(), elapsed.count()));
    } else {
        console.result(paths_text(job, results) + (writes_index ? index_paths_text(job) : ""));
    }
    report_warnings(results, console);
    console.note(
        fmt::format("{} baked, {:.2g} s\n", variants_text(reporter.made()), elapsed.count()));
    if (writes_index) console.note(earlier_note(folders_of_earlier_sweeps(job)));
    return report_unfinished(results, console);
}

ExitCode run_sweep(const Invocation& invocation, Console& console) {
    if (const ExitCode code = console.report(contradictions(invocation)); code != ExitCode::done) {
        return code;
    }
    auto found = sweep_of(invocation);
    if (const ExitCode code = console.report(found.diagnostics); !found.value) return code;
    auto job = sweep_job(invocation, std::move(*found.value));
    if (const ExitCode code = console.report(job.diagnostics); !job.value) return code;
    if (invocation.has("emit")) return emit(invocation, *job.value, console);
    return sweep(invocation, *job.value, console);
}

}  // namespace

Command sweep_command() {
    return {
        .name = "sweep",
        .brief = "bake many variants",
        .summary = "bake variants of a recipe, one folder for each, and an index of them",
        .arguments = {{.name = "recipe.toml",
                       .help = "the recipe, whose [sweep] says what varies"}},
        .options =
            {{.name = "output",
              .short_name = 'o',
              .value = "FOLDER",
              .help = "write the variants' folders into this folder",
              .fallback = "sweep"},
             {.name = "vary",
              .value = "KEY=VALUES",
              .help = "vary KEY over FROM:TO:COUNT[:log] or A,B,C instead of [sweep]",
              .repeatable = true},
             {.name = "zip",
              .value = "KEY,KEY",
              .help = "vary keys in lockstep instead of crossing them",
              .repeatable = true},
             {.name = "sobol", .value = "N", .help = "spread N points over ranges without a count"},
             set_option(),
             {.name = "shard", .value = "I/N", .help = "bake part I of N and leave out the index"},
             {.name = "merge", .help = "write the index of baked variants without baking"},
             {.name = "emit",
              .value = "ENGINE",
              .help = "print a script for a farm",
              .choices = {"slurm", "commands", "ninja"}},
             {.name = "tasks",
              .value = "N",
              .help = "split the script into N tasks (default: one per variant, up to 1000)"},
             {.name = "certify",
              .value = "HOW",
              .help = "how thoroughly to measure errors",
              .choices = {"quick", "full", "off"},
              .fallback = "quick"},
             jobs_option("use N threads, for variants side by side first (default: all)"),
             {.name = "dry-run",
              .help = "show which variants would be baked and why, without baking"},
             cache_option(),
             {.name = "max-memory",
              .value = "SIZE",
              .help = "limit the memory of all variants at once (2GiB, 500M)"},
             {.name = "force", .help = "overwrite files that skybake did not write"}},
        .examples = {{"skybake sweep sky.toml --vary clouds.c.coverage=0.2:0.8:4 "
                      "--vary noise.n.seed=1,2",
                      "bakes 8 variants"},
                     {"skybake sweep sky.toml --shard 1/2", "bakes half of the variants"},
                     {"skybake sweep sky.toml --emit slurm > sweep.sh",
                      "writes a script; bash sweep.sh submits it"}},
        .exit_codes = {ExitCode::io, ExitCode::checks},
        .run = run_sweep};
}

}  // namespace skybake::cli
