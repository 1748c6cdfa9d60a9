// This header declares what a bake tells. People get the plan before it and a table after it;
// programs get JSON Lines, which event_schema.json describes.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "bakers/workspace/bake_folder.h"
#include "config/diagnostics/diagnostic.h"

namespace skybake::cli {

class Console;

// Tells people, or programs with --json, how a bake of a folder goes.
class BakeReporter : public BakeObserver {
  public:
    explicit BakeReporter(Console& console) : console_(console) {}

    bool cancelled() const override;
    void waits() override;
    void planned(const FolderPlan& plan) override;
    std::unique_ptr<Progress> begin(std::string_view asset) override;

  private:
    Console& console_;
    std::vector<std::string> stale_;  // the assets that are to be made, in order
};

// Returns the plan as a table with one row per asset: size, files, estimated time and disk, and why
// it is to be baked.
std::string plan_text(const FolderPlan& plan);

// Says why assets that were baked before are baked again, one line each. New assets are left out.
std::string reasons_text(const FolderPlan& plan);

// Returns a table with one row per file that was made, within so many columns (0: no limit). The
// first row of an asset has its size, times and errors. After the table it says what became of files
// of earlier recipes, which --prune asked to remove, and gives totals, with the time of the command.
std::string summary_text(const BakedFolder& baked, double seconds, int columns, bool prune);

// Spells an extent: "256x64", "128x128x128".
std::string extent_text(std::span<const int> size);
// Returns the names of channels in a row: "RGB", or with spaces where they are words.
std::string channels_text(const ManifestAsset& asset);

// Returns a warning if a bake is estimated to take more than ten minutes of one core.
std::vector<Diagnostic> long_bake(const FolderPlan& plan);

std::string plan_event(const FolderPlan& plan);

// Returns one event per file, and then the last event of the bake.
std::string finished_events(const BakedFolder& baked, const std::filesystem::path& folder,
                            double seconds);

// Returns the median and the largest error of an asset's light and the noise of what it is compared
// with, one standard error: "0.31 / 2.4 ± 0.2 %", or "too noisy to tell". Returns nothing if its
// light is not compared.
std::string sky_error_text(const std::optional<Certificate>& error);

// Returns the median and the largest error of the colours that a recipe's wavelengths make:
// "0.2 / 1.4 %". Returns nothing if the recipe has no colours.
std::string color_error_text(const std::optional<Certificate>& error);

}  // namespace skybake::cli
