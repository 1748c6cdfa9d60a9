// What a bake tells people: the plan before it, the table after it.
#pragma once

#include <span>
#include <string>

#include "bakers/workspace/bake_folder.h"

namespace skybake::cli {

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

}  // namespace skybake::cli
