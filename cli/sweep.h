// This header declares the options of a sweep, what a sweep tells, and the tasks into which farms
// divide it.
#pragma once

#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "bakers/io/files/stopwatch.h"
#include "bakers/workspace/sweep/run_sweep.h"
#include "cli/options.h"
#include "cli/progress.h"

namespace skybake::cli {

namespace options {

Outcome<int> read_tasks(const std::string& text);
Outcome<std::pair<int, int>> read_shard(const std::string& text);

inline const Option<Texts> vary{"vary", 0, "KEY=VALUES"};
inline const Option<Texts> zip{"zip", 0, "KEY,KEY"};
inline const Option<std::string> sobol{"sobol", 0, "N"};
inline const Option<std::pair<int, int>> shard{"shard", 0, "I/N", {}, read_shard};  // I, N
inline const Option<bool> merge{"merge"};
inline const Option<bool> emit{"emit", 0, "WHAT", {{"commands", true}}};
inline const Option<int> tasks{"tasks", 0, "N", {}, read_tasks};

}  // namespace options

// Tells people, or programs with --json, how a sweep goes. On a terminal one line is rewritten.
// Elsewhere there is a line for each variant that was made, and one every ten seconds.
class SweepReporter : public SweepObserver {
  public:
    SweepReporter(const SweepJob& job, std::size_t variants, Console& console);

    bool cancelled() const override;
    void advance(const VariantResult& variant, std::string_view step, double fraction) override;
    void waits(const VariantResult& variant) override;
    void finished(const VariantResult& variant, bool made, double seconds) override;

    // Removes the line.
    void finish();

    // Returns how many variants were made in this run.
    int made() const { return made_; }

  private:
    std::string count_text() const;
    std::string text() const;

    const SweepJob& job_;
    std::size_t variants_;
    Console& console_;
    const Stopwatch stopwatch_;
    mutable std::mutex mutex_;  // protects the members below
    std::size_t finished_ = 0;
    int made_ = 0;
    int worked_on_ = 0;  // made or failed in this run
    int failed_ = 0;
    std::string at_work_;  // "0002_seed=3: voxels 40 %"
    std::optional<ProgressLine> line_;
};

// Returns a summary of the plan: "12 variants, 6 in this shard, 2 up to date; 4 share shape (baked
// once)".
std::string plan_note(const SweepJob& job, const std::vector<PlannedVariant>& plan);

// Returns a line for everything that is made once for several variants: "made once: solved light (2 s,
// 8.0 MiB) for 12 variants".
std::string intermediates_note(const std::vector<PlannedVariant>& plan);

// Returns a note on folders of earlier sweeps: "2 folders are no longer in the sweep; kept:
// 0004_seed=5, 0005_seed=6". It is empty if there are none.
std::string earlier_note(const std::vector<std::string>& folders);

// Returns a table with one row per variant: its name, and why it is to be baked.
std::string plan_table(const std::vector<PlannedVariant>& plan);

// These are the events of --json, which event_schema.json describes.
std::string sweep_event(const SweepJob& job, const std::vector<PlannedVariant>& plan);
std::string planned_variant_events(const SweepJob& job, const std::vector<PlannedVariant>& plan);
std::string swept_event(const std::vector<VariantResult>& results, int made, double seconds);

// Returns E0406, such as "2 of 12 variants failed", or nothing if all are done.
[[nodiscard]] std::vector<Diagnostic> unfinished(const std::vector<VariantResult>& results);

// --- Tasks for farms ----------------------------------------------------------------------------

// Quotes a word so that a POSIX shell reads it back unchanged.
std::string shell_word(std::string_view text);

// Prints what --emit asks for: one task per line, without the merge. A task is a shard of the sweep,
// and may safely be run again, for example after a node has died. The lines are shell commands,
// quoted so that `sh`, GNU parallel and `xargs -d '\n' -I{} sh -c '{}'` run them from any folder; the
// programs of examples/farm/ hand them to engines. Reports E0001 for values that no line can hold.
ExitCode emit_tasks(const Invocation& invocation, const SweepJob& job, Console& console);

}  // namespace skybake::cli
