#include "cli/sweep.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>

#include "bakers/io/files/load_module.h"
#include "bakers/workspace/http_cache.h"
#include "bakers/workspace/sweep/index_files.h"
#include "bakers/workspace/sweep/variants.h"
#include "cli/events.h"

namespace skybake::cli {
namespace {

namespace fs = std::filesystem;

bool is_safe_in_shells(char c) {
    const bool letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
    const bool digit = c >= '0' && c <= '9';
    return letter || digit || std::string_view("_-./=:,+%@").find(c) != std::string_view::npos;
}

std::string base_command(const SweepScript& script) {
    std::string text;
    for (const std::string& word : script.words) text += shell_word(word) + ' ';
    return text;
}

// Escapes the value of a variable. In it, only `$` is special to ninja.
std::string ninja_value(std::string_view text) {
    std::string value;
    for (const char c : text) value += c == '$' ? "$$" : std::string(1, c);
    return value;
}

// Escapes a path in a build line. There the characters that end a path are special too.
std::string ninja_path(std::string_view text) {
    std::string path;
    for (const char c : text) {
        if (c == '$' || c == ' ' || c == ':') path += '$';
        path += c;
    }
    return path;
}

// Returns the command of a task in ninja's escaping. The `$` of `$task` is not escaped, because
// ninja replaces it.
std::string ninja_task_command(const SweepScript& script) {
    SweepScript escaped = script;
    for (std::string& word : escaped.words) word = ninja_value(word);
    return task_command(escaped, "$task");
}

// Returns the path of a variant's stamp. The stamp is not manifest.json itself: ninja deletes the
// outputs of an interrupted command, and without the manifest no file of the folder would be known
// as skybake's.
std::string ninja_stamp(const SweepScript& script, std::size_t variant) {
    return ninja_path(
        (std::filesystem::path(script.folder) / script.names[variant] / "ninja.stamp").string());
}

// Returns the stamps of a task's variants (see SweepJob::shard).
std::string ninja_stamps(const SweepScript& script, int task) {
    std::string stamps;
    for (auto i = static_cast<std::size_t>(task - 1); i < script.names.size();
         i += static_cast<std::size_t>(script.tasks)) {
        stamps += " " + ninja_stamp(script, i);
    }
    return stamps;
}

std::string ninja_inputs(const SweepScript& script) {
    std::string inputs;
    for (const std::filesystem::path& input : script.inputs) {
        inputs += " " + ninja_path(input.string());
    }
    return inputs;
}

// Returns the ninja rules. The outputs are touched, because files that are up to date keep their
// time stamps. The stamps of a task stand in a file, because they may be too many for a command
// line.
std::string ninja_rules(const SweepScript& script) {
    const auto list = std::filesystem::path(script.folder) / "ninja-task-";
    return fmt::format(
        "rule task\n"
        "  command = {task} && xargs touch < {list}$task || [ $$? -eq {checks} ]\n"
        "  rspfile = {list_path}$task\n"
        "  rspfile_content = $out\n"
        "  description = sweep, task $task of {tasks}\n\n"
        "rule merge\n"
        "  command = {merge} && touch $out\n"
        "  description = sweep, index\n\n",
        fmt::arg("task", ninja_task_command(script)),
        fmt::arg("list", ninja_value(shell_word(list.string()))),
        fmt::arg("checks", static_cast<int>(ExitCode::checks)),
        fmt::arg("list_path", ninja_value(list.string())), fmt::arg("tasks", script.tasks),
        fmt::arg("merge", ninja_value(merge_command(script))));
}

// --- From the command line ----------------------------------------------------------------------

// Returns the path of the program itself, so that a node finds it whatever its PATH is.
std::string program_path() {
    const std::vector<fs::path> files = program_files();
    return files.empty() ? "skybake" : files.front().string();
}

// Makes a path absolute, because a farm starts its tasks in other folders.
std::string absolute_path(const fs::path& path) { return fs::absolute(path).string(); }

// Adds an option in the user's own words.
template <class T>
void add_typed(const Invocation& invocation, const Option<T>& option,
               std::vector<std::string>& words) {
    for (const std::string& text : invocation.typed(option)) {
        words.push_back(fmt::format("--{}", option.name));
        words.push_back(text);
    }
}

std::vector<std::string> script_words(const Invocation& invocation) {
    std::vector<std::string> words = {program_path(), "sweep",
                                      absolute_path(invocation.arguments()[0])};
    for (const Option<options::Texts>* option : {&options::set, &options::vary, &options::zip}) {
        add_typed(invocation, *option, words);
    }
    add_typed(invocation, options::sobol, words);
    add_typed(invocation, options::certify, words);
    add_typed(invocation, options::max_memory, words);
    if (invocation.has(options::cache_dir)) {
        words.emplace_back("--cache-dir");
        words.push_back(absolute_path(invocation[options::cache_dir]));
    }
    add_typed(invocation, options::cache, words);
    if (invocation[options::force]) words.emplace_back("--force");
    words.emplace_back("-o");
    words.push_back(absolute_path(invocation[options::output]));
    return words;
}

// Returns all files that any variant is made from, including the program's own.
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

// Slurm limits an array job to MaxArraySize, which is 1001 unless somebody has raised it.
constexpr int most_tasks = 1000;

Outcome<SweepScript> sweep_script(const Invocation& invocation, const SweepJob& job) {
    if (invocation.has(options::cache)) {
        const std::string url = invocation[options::cache];
        if (without_credentials(url) != url) {
            return {
                {},
                {usage_error(
                    "--emit: the script would show the password of --cache",
                    "set $SKYBAKE_CACHE where the tasks run, or write it into their ~/.netrc")}};
        }
    }
    SweepScript script;
    script.words = script_words(invocation);
    script.folder = absolute_path(job.folder);
    script.variants = variant_count(job.sweep);
    script.tasks = std::min(script.variants, most_tasks);
    script.threads = job.threads > 0 ? job.threads : 1;
    if (invocation.has(options::tasks)) {
        script.tasks = std::min(invocation[options::tasks], script.variants);
    }
    const ScriptEngine engine = invocation[options::emit];
    for (const std::string& word : script.words) {
        if (word.find('\n') != std::string::npos) {
            return {{},
                    {usage_error("--emit: a value holds a line break, but a task is one line")}};
        }
        if (engine == ScriptEngine::openjd && word.find("{{") != std::string::npos) {
            return {{},
                    {usage_error(
                        "--emit: a value holds `{{`, which Open Job Description would replace")}};
        }
    }
    if (invocation.has(options::image) != (engine == ScriptEngine::kubernetes)) {
        return {{},
                {usage_error("--emit kubernetes needs --image, which names a container image that "
                             "has skybake; other engines do not use it")}};
    }
    if (engine == ScriptEngine::kubernetes) {
        script.image = invocation[options::image];
        script.mounts = {fs::absolute(job.recipe).parent_path(), fs::absolute(job.folder)};
        if (!job.cache.empty()) script.mounts.push_back(fs::absolute(job.cache));
    }
    return {std::move(script), {}};
}

std::string script_text(ScriptEngine engine, const SweepJob& job, SweepScript script) {
    if (engine == ScriptEngine::slurm) return slurm_script(script);
    if (engine == ScriptEngine::commands) return command_lines(script);
    if (engine == ScriptEngine::openjd) return openjd_template(script);
    if (engine == ScriptEngine::kubernetes) return kubernetes_job(script);
    script.inputs = sweep_inputs(job);
    const VariantNames names(job.sweep);
    for (int i = 0; i < script.variants; ++i) script.names.push_back(names.name(i));
    return ninja_file(script);
}

}  // namespace

std::string shell_word(std::string_view text) {
    bool safe = !text.empty();
    for (const char c : text) safe = safe && is_safe_in_shells(c);
    if (safe) return std::string(text);
    std::string quoted = "'";
    for (const char c : text) quoted += c == '\'' ? R"('\'')" : std::string(1, c);
    return quoted + "'";
}

std::string task_command(const SweepScript& script, std::string_view task) {
    return fmt::format("{}-j {} --shard {}/{}", base_command(script), script.threads, task,
                       script.tasks);
}

std::string merge_command(const SweepScript& script) { return base_command(script) + "--merge"; }

std::string command_lines(const SweepScript& script) {
    std::string text;
    for (int task = 1; task <= script.tasks; ++task) {
        text += task_command(script, std::to_string(task)) + '\n';
    }
    return text;
}

std::string slurm_script(const SweepScript& script) {
    return fmt::format(
        R"(#!/usr/bin/env bash
# A sweep of {variants} variants in {tasks} tasks, and the merge that follows them. Run it, do not
# submit it:
#   bash THIS_FILE [options of sbatch, such as --partition=render]
# Tasks may be requeued or run again: what is up to date is left alone. The merge runs whatever
# becomes of them, and lists what is missing.
set -euo pipefail

tasks=$(sbatch "$@" --parsable <<'TASKS'
#!/usr/bin/env bash
#SBATCH --job-name=skybake-sweep
#SBATCH --array=1-{tasks}
#SBATCH --ntasks=1
#SBATCH --cpus-per-task={threads}
#SBATCH --requeue
exec {task}
TASKS
)

merge=$(sbatch "$@" --parsable --dependency="afterany:${{tasks%%;*}}" <<'MERGE'
#!/usr/bin/env bash
#SBATCH --job-name=skybake-merge
#SBATCH --ntasks=1
#SBATCH --requeue
exec {merge}
MERGE
)

echo "tasks ${{tasks%%;*}}"
echo "merge ${{merge%%;*}}"
)",
        fmt::arg("variants", script.variants), fmt::arg("tasks", script.tasks),
        fmt::arg("threads", script.threads),
        fmt::arg("task", task_command(script, R"("$SLURM_ARRAY_TASK_ID")")),
        fmt::arg("merge", merge_command(script)));
}

std::string ninja_file(const SweepScript& script) {
    std::string text = fmt::format(
        "# A sweep of {} variants in {} tasks: ninja -f THIS_FILE\n"
        "ninja_required_version = 1.5\n\n",
        script.variants, script.tasks);
    text += ninja_rules(script);
    const std::string inputs = ninja_inputs(script);
    std::string all_stamps;
    for (int task = 1; task <= script.tasks; ++task) {
        const std::string stamps = ninja_stamps(script, task);
        all_stamps += stamps;
        text += fmt::format("build{}: task |{}\n  task = {}\n", stamps, inputs, task);
    }
    text += "build";
    for (const std::string_view name : index_names) {
        text += " " + ninja_path((std::filesystem::path(script.folder) / name).string());
    }
    return text + ": merge |" + all_stamps + "\n";
}

ExitCode emit_script(const Invocation& invocation, const SweepJob& job, Console& console) {
    const auto script = sweep_script(invocation, job);
    if (const ExitCode code = console.report(script.diagnostics); !script.value) return code;
    const ScriptEngine engine = invocation[options::emit];
    const std::string text = script_text(engine, job, *script.value);
    const std::string merge = merge_command(*script.value);
    if (console.display().json) {
        console.result(event_line({{"event", "script"},
                                   {"engine", invocation.typed(options::emit).back()},
                                   {"text", text},
                                   {"merge", merge}}));
        return ExitCode::done;
    }
    console.result(text);
    if (engine == ScriptEngine::commands || engine == ScriptEngine::kubernetes) {
        console.note(fmt::format("when all are done, write the index: {}\n", merge));
    }
    return ExitCode::done;
}

}  // namespace skybake::cli
