// What a bake tells: people, the plan before it and the table after it; programs, JSON Lines as
// event_schema.json describes them.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "bakers/workspace/bake_folder.h"

namespace skybake::cli {

class Console;

// Tells people, or with --json programs, how a bake of a folder goes.
class BakeReporter : public BakeObserver {
  public:
    BakeReporter(Console& console, bool json) : console_(console), json_(json) {}

    bool cancelled() const override;
    void waits() override;
    void planned(const FolderPlan& plan) override;
    std::unique_ptr<Progress> begin(std::string_view asset) override;

  private:
    Console& console_;
    bool json_;
    std::vector<std::string> stale_;  // what is to be made, in order
};

// One row per asset: size, files, estimated time and disk, and why it is to be baked.
std::string plan_text(const FolderPlan& plan);

// Why assets that were baked before are baked again, one line each; new ones are left out.
std::string reasons_text(const FolderPlan& plan);

struct SummaryOptions {
    double seconds = 0;  // of the whole command
    int columns = 0;     // of the terminal; 0: any number
    bool prune = false;  // files of earlier recipes were to be removed
};

// One row per file that was made, the first of an asset with its size, times and errors; then what
// became of files of earlier recipes, and totals.
std::string summary_text(const BakedFolder& baked, const SummaryOptions& options);

// "256x64", "128x128x128".
std::string extent_text(std::span<const int> size);

std::string plan_event(const FolderPlan& plan);

// One event per file, then the last one.
std::string finished_events(const BakedFolder& baked, const std::filesystem::path& folder,
                            double seconds);

}  // namespace skybake::cli
