// skybake sweep: one recipe, many values.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <chrono>
#include <filesystem>
#include <set>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "bakers/io/file_diagnostic.h"
#include "bakers/io/manifest.h"
#include "bakers/sweep/index_files.h"
#include "bakers/sweep/run_sweep.h"
#include "bakers/sweep/variant_names.h"
#include "cli/bake_selection.h"
#include "cli/byte_size.h"
#include "cli/cache_folder.h"
#include "cli/command.h"
#include "cli/console.h"
#include "cli/interrupt.h"
#include "cli/parse_arguments.h"
#include "cli/sweep_reporter.h"
#include "cli/sweep_scripts.h"
#include "config/diagnostic_codes.h"
#include "config/recipe.h"

namespace skybake::cli {
namespace {

namespace fs = std::filesystem;
using config::Diagnostic;
using config::Outcome;

// Every variant reads the recipe again, which a pipe cannot give twice: opening it would wait.
std::vector<Diagnostic> check_rereadable(const fs::path& recipe) {
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
            {usage_error("nothing varies: the recipe has no [sweep], and there is no --vary",
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
            {usage_error(fmt::format("--shard: `{}` is no shard", text),
                         "I/N: part I of N, from 1/N to N/N")}};
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
    std::error_code error;
    const fs::path program = fs::read_symlink("/proc/self/exe", error);
    return error ? "skybake" : program.string();
}

std::vector<std::string> script_words(const Invocation& invocation) {
    std::vector<std::string> words = {program_path(), "sweep", invocation.arguments()[0]};
    for (const char* option : {"set", "vary", "zip"}) {
        for (const std::string& value : invocation.values(option)) {
            words.push_back(fmt::format("--{}", option));
            words.push_back(value);
        }
    }
    for (const char* option : {"sobol", "certify", "cache-dir", "max-memory"}) {
        if (!invocation.has(option)) continue;
        words.push_back(fmt::format("--{}", option));
        words.push_back(invocation.value(option));
    }
    if (invocation.has("force")) words.emplace_back("--force");
    words.emplace_back("-o");
    words.push_back(invocation.value("output"));
    return words;
}

// All files that any variant is made from, the program among them.
std::vector<fs::path> sweep_inputs(const SweepJob& job) {
    std::vector<fs::path> inputs;
    if (const fs::path program = program_path(); program.is_absolute()) inputs.push_back(program);
    std::set<fs::path> known;
    for (int i = 0; i < variant_count(job.sweep); ++i) {
        const auto recipe = config::load_variant(job.recipe, job.settings, job.sweep, i);
        if (!recipe.value) continue;
        for (const fs::path& input : recipe.value->inputs) {
            if (known.insert(input).second) inputs.push_back(input);
        }
    }
    return inputs;
}

// Slurm's own limit of an array job, MaxArraySize, is 1001 where nobody has raised it.
constexpr int most_tasks = 1000;

Outcome<SweepScript> sweep_script(const Invocation& invocation, const SweepJob& job) {
    SweepScript script;
    script.words = script_words(invocation);
    script.folder = job.folder.string();
    script.variants = variant_count(job.sweep);
    script.tasks = std::min(script.variants, most_tasks);
    script.threads = job.threads > 0 ? job.threads : 1;
    if (invocation.has("tasks")) {
        const auto tasks = count_of(invocation.value("tasks"));
        if (!tasks) {
            return {{},
                    {usage_error(fmt::format("--tasks: `{}` is no number of tasks",
                                             invocation.value("tasks")),
                                 fmt::format("1 to {}", config::most_variants))}};
        }
        script.tasks = std::min(*tasks, script.variants);
    }
    for (const std::string& word : script.words) {
        if (word.find('\n') == std::string::npos) continue;
        return {{}, {usage_error("--emit: a value with a line break fits no script's line")}};
    }
    return {std::move(script), {}};
}

ExitCode emit(const Invocation& invocation, const SweepJob& job, Console& console) {
    auto script = sweep_script(invocation, job);
    if (const ExitCode code = console.report(script.diagnostics); !script.value) return code;
    const std::string engine = invocation.value("emit");
    if (engine == "slurm") {
        console.result(slurm_script(*script.value));
    } else if (engine == "ninja") {
        script.value->inputs = sweep_inputs(job);
        const VariantNames names(job.sweep);
        for (int i = 0; i < script.value->variants; ++i) {
            script.value->names.push_back(names.name(i));
        }
        console.result(ninja_file(*script.value));
    } else {
        console.result(command_lines(*script.value));
        console.note(fmt::format("and when all are done: {}\n", merge_command(*script.value)));
    }
    return ExitCode::done;
}

// --- Making -------------------------------------------------------------------------------------

// The same warning of many variants is one.
void report_warnings(const std::vector<VariantResult>& results, Console& console) {
    std::set<std::pair<std::string, std::string>> known;
    std::vector<Diagnostic> warnings;
    for (const VariantResult& result : results) {
        for (const Diagnostic& diagnostic : result.diagnostics) {
            if (diagnostic.severity != config::Severity::warning) continue;
            if (known.emplace(diagnostic.code, diagnostic.message).second) {
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
        text += (job.folder / result.name / manifest_name).string() + "\n";
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

ExitCode sweep(const Invocation& invocation, const SweepJob& job, Console& console) {
    const auto start = std::chrono::steady_clock::now();
    const bool json = invocation.has("json");
    const bool merge = invocation.has("merge");
    const bool writes_index = job.shards == 1;
    if (writes_index) {
        const auto obstacles = inspect_index(job.folder, job.force);
        if (const ExitCode code = console.report(obstacles); code != ExitCode::done) return code;
    }
    std::vector<PlannedVariant> plan = plan_sweep(job, interrupted);
    if (interrupted()) return ExitCode::interrupted;
    if (writes_index && all_failed(plan)) return console.report(plan[0].result.diagnostics);
    if (invocation.has("dry-run")) return dry_run(job, plan, json, console);
    if (json) console.result(sweep_event(job, plan));
    if (!merge) console.note(plan_note(job, plan));

    SweepReporter reporter(job, plan.size(), console, json);
    const std::vector<VariantResult> results = make(job, std::move(plan), merge, reporter);
    if (interrupted()) return ExitCode::interrupted;
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
    console.note(fmt::format("{} made, {:.2g} s\n", reporter.made(), elapsed.count()));
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
        .brief = "one recipe, many values",
        .summary = "bake one recipe with many values, a folder for each, and an index",
        .arguments = {{.name = "recipe.toml", .help = "the recipe; [sweep] says what varies"}},
        .options = {{.name = "output",
                     .short_name = 'o',
                     .value = "FOLDER",
                     .help = "where the variants' folders go",
                     .fallback = "sweep"},
                    {.name = "vary",
                     .value = "KEY=VALUES",
                     .help = "FROM:TO:COUNT[:log] or A,B,C; in place of [sweep]'s own",
                     .repeatable = true},
                    {.name = "zip",
                     .value = "KEY,KEY",
                     .help = "keys that walk together, not across",
                     .repeatable = true},
                    {.name = "sobol", .value = "N", .help = "points over ranges without a count"},
                    set_option(),
                    {.name = "shard", .value = "I/N", .help = "part I of N, without the index"},
                    {.name = "merge", .help = "bake nothing, write the index of what is there"},
                    {.name = "emit",
                     .value = "ENGINE",
                     .help = "print a script for a farm",
                     .choices = {"slurm", "commands", "ninja"}},
                    {.name = "tasks",
                     .value = "N",
                     .help = "tasks in that script (default: one a variant, at most 1000)"},
                    {.name = "certify",
                     .value = "HOW",
                     .help = "error measurement",
                     .choices = {"quick", "full", "off"},
                     .fallback = "quick"},
                    jobs_option("threads, over variants first (default: all)"),
                    {.name = "dry-run", .help = "list the variants and why each would be made"},
                    cache_option(),
                    {.name = "max-memory",
                     .value = "SIZE",
                     .help = "of all variants at once, such as 2GiB"},
                    {.name = "force", .help = "overwrite files that skybake did not write"},
                    {.name = "json", .help = "events as JSON Lines on stdout"}},
        .examples = {{"skybake sweep sky.toml --vary clouds.c.coverage=0.2:0.8:4 "
                      "--vary noise.n.seed=1,2",
                      "8 variants"},
                     {"skybake sweep sky.toml --shard 1/2", "half of what [sweep] asks for"},
                     {"skybake sweep sky.toml --emit slurm > sweep.sh",
                      "bash sweep.sh submits it"}},
        .exit_codes = {ExitCode::io, ExitCode::checks},
        .run = run_sweep};
}

}  // namespace skybake::cli
