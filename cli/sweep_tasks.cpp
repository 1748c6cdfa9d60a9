// The commands that divide a sweep among the tasks of a farm.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "bakers/io/files/load_module.h"
#include "bakers/workspace/http_cache.h"
#include "cli/events.h"
#include "cli/sweep.h"
#include "config/text/text.h"

namespace skybake::cli {
namespace {

namespace fs = std::filesystem;

bool is_safe_in_shells(char c) {
    const bool letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
    const bool digit = c >= '0' && c <= '9';
    return letter || digit || std::string_view("_-./=:,+%@").find(c) != std::string_view::npos;
}

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

// Returns the words of the sweep without --shard and --merge.
std::vector<std::string> sweep_words(const Invocation& invocation) {
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

// Returns why no script may hold these words.
std::vector<Diagnostic> obstacles(const Invocation& invocation,
                                  const std::vector<std::string>& words) {
    if (invocation.has(options::cache)) {
        const std::string url = invocation[options::cache];
        if (without_credentials(url) != url) {
            return {usage_error(
                "--emit: the script would show the password of --cache",
                "set $SKYBAKE_CACHE where the tasks run, or write it into their ~/.netrc")};
        }
    }
    const auto has_break = [](const std::string& word) { return word.find('\n') != word.npos; };
    if (std::ranges::none_of(words, has_break)) return {};
    return {usage_error("--emit: a value holds a line break, but a task is one line")};
}

// Slurm limits an array job to MaxArraySize, which is 1001 unless somebody has raised it.
constexpr int most_tasks = 1000;

int task_count(const Invocation& invocation, const SweepJob& job) {
    const bool is_given = invocation.has(options::tasks);
    return std::min(is_given ? invocation[options::tasks] : most_tasks, variant_count(job.sweep));
}

}  // namespace

std::string shell_word(std::string_view text) {
    if (!text.empty() && std::ranges::all_of(text, is_safe_in_shells)) return std::string(text);
    return fmt::format("'{}'", config::replaced(text, {{'\'', R"('\'')"}}));
}

ExitCode emit_tasks(const Invocation& invocation, const SweepJob& job, Console& console) {
    const std::vector<std::string> words = sweep_words(invocation);
    const ExitCode code = console.report(obstacles(invocation, words));
    if (code != ExitCode::done) return code;
    std::string command;
    for (const std::string& word : words) command += shell_word(word) + ' ';
    const std::string merge = command + "--merge";
    const int tasks = task_count(invocation, job);
    std::string text;
    for (int task = 1; task <= tasks; ++task) {
        text +=
            fmt::format("{}-j {} --shard {}/{}\n", command, std::max(job.threads, 1), task, tasks);
    }
    if (console.json()) {
        console.result(event_line(
            {{"event", "script"}, {"engine", "commands"}, {"text", text}, {"merge", merge}}));
        return ExitCode::done;
    }
    console.result(text);
    console.note(fmt::format("when all are done, write the index: {}\n", merge));
    return ExitCode::done;
}

}  // namespace skybake::cli
