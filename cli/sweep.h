// What a sweep tells, and the scripts that farms run.
#pragma once

#include <chrono>
#include <filesystem>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "bakers/workspace/sweep/run_sweep.h"
#include "cli/options.h"
#include "cli/progress.h"
#include "config/sweep/sweep.h"

namespace skybake::cli {

enum class ScriptEngine { slurm, commands, ninja };

namespace options {

config::Outcome<int> read_tasks(const std::string& text);
config::Outcome<std::pair<int, int>> read_shard(const std::string& text);

inline const Option<Texts> vary{"vary", 0, "KEY=VALUES"};
inline const Option<Texts> zip{"zip", 0, "KEY,KEY"};
inline const Option<std::string> sobol{"sobol", 0, "N"};
inline const Option<std::pair<int, int>> shard{"shard", 0, "I/N", {}, read_shard};  // I, N
inline const Option<bool> merge{"merge"};
inline const Option<ScriptEngine> emit{"emit",
                                       0,
                                       "ENGINE",
                                       {{"slurm", ScriptEngine::slurm},
                                        {"commands", ScriptEngine::commands},
                                        {"ninja", ScriptEngine::ninja}}};
inline const Option<int> tasks{"tasks", 0, "N", {}, read_tasks};

}  // namespace options

// Tells people, or with --json programs, how a sweep goes: on a terminal one line that is
// rewritten, elsewhere a line for each variant that was made and one every ten seconds.
class SweepReporter : public SweepObserver {
  public:
    SweepReporter(const SweepJob& job, std::size_t variants, Console& console, bool json);

    bool cancelled() const override;
    void advance(const VariantResult& variant, std::string_view step, double fraction) override;
    void waits(const VariantResult& variant) override;
    void finished(const VariantResult& variant, bool made, double seconds) override;

    // Takes the line away.
    void finish();

    // How many were made anew.
    int made() const { return made_; }

  private:
    std::string count_text() const;
    std::string text() const;

    const SweepJob& job_;
    std::size_t variants_;
    Console& console_;
    bool json_;
    std::chrono::steady_clock::time_point start_;
    mutable std::mutex mutex_;  // of what follows
    std::size_t finished_ = 0;
    int made_ = 0;
    int failed_ = 0;
    std::string at_work_;  // "0002_seed=3: voxels 40 %"
    std::optional<ProgressLine> line_;
};

// "12 variants, 6 in this shard, 2 up to date; 4 share shape (baked once)".
std::string plan_note(const SweepJob& job, const std::vector<PlannedVariant>& plan);

// "2 folders are no longer in the sweep; kept: 0004_seed=5, 0005_seed=6"; empty for none.
std::string earlier_note(const std::vector<std::string>& folders);

// One row per variant: its name, and why it is to be baked.
std::string plan_table(const std::vector<PlannedVariant>& plan);

// Events of --json; event_schema.json describes them.
std::string sweep_event(const SweepJob& job, const std::vector<PlannedVariant>& plan);
std::string planned_variant_events(const SweepJob& job, const std::vector<PlannedVariant>& plan);
std::string swept_event(const std::vector<VariantResult>& results, int made, double seconds);

// "2 of 12 variants failed" and so on: E0406. None if all are done.
[[nodiscard]] std::vector<config::Diagnostic> unfinished(const std::vector<VariantResult>& results);

// --- Scripts for farms --------------------------------------------------------------------------

// A script hands a sweep to an engine that a farm has already. Its tasks are shards of the sweep: a
// task that is run again, after a node has died, does no harm.
struct SweepScript {
    std::vector<std::string> words;  // of the command without --shard and --merge
    std::string folder;              // of the sweep
    int variants = 0;
    int tasks = 0;
    int threads = 1;                            // of a task
    std::vector<std::filesystem::path> inputs;  // what the variants are made from
    std::vector<std::string> names;             // of all variants' folders; inputs and names are
                                                // for ninja_file alone
};

// A word that a POSIX shell reads back as it is.
std::string shell_word(std::string_view text);

// The command of one task, or of the merge that ends the sweep, for a shell.
std::string task_command(const SweepScript& script, std::string_view task);
std::string merge_command(const SweepScript& script);

// One task per line, without the merge: commands of a shell, quoted so that `sh`, GNU parallel and
// `xargs -d '\n' -I{} sh -c '{}'` run them from any folder.
std::string command_lines(const SweepScript& script);

// A shell script that submits an array job and, after it, the merge. Its arguments go to sbatch.
std::string slurm_script(const SweepScript& script);

// A build.ninja: a stamp in each variant's folder, and the index files. A task with variants that
// fail leaves their stamps as they are, so that it is run again, and lets the merge run, which
// fails in its place.
std::string ninja_file(const SweepScript& script);

// Prints the script that --emit asks for. E0001 for --tasks and for values that no line can hold.
ExitCode emit_script(const Invocation& invocation, const SweepJob& job, Console& console);

}  // namespace skybake::cli
