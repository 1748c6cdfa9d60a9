// Tells people, or with --json machines, how a sweep goes.
#pragma once

#include <chrono>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "bakers/workspace/sweep/run_sweep.h"
#include "cli/progress_line.h"

namespace skybake::cli {

class Console;

// On a terminal one line that is rewritten, elsewhere a line for each variant that was made and one
// every ten seconds.
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
std::vector<config::Diagnostic> unfinished(const std::vector<VariantResult>& results);

}  // namespace skybake::cli
