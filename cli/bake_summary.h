// What a bake says to people: the plan before, the table after.
#pragma once

#include <span>
#include <string>

#include "bakers/incremental/bake_folder.h"

namespace skybake::cli {

// One row an asset: size, files, estimated time and disk, and why it is to be made.
std::string plan_text(const FolderPlan& plan);

// Why assets that were baked before are made again, a line each; those that are new say nothing.
std::string reasons_text(const FolderPlan& plan);

// One row a file that was made, the first of an asset with its size, times and errors; then totals.
std::string summary_text(const BakedFolder& baked, double seconds);

// "256x64", "128x128x128".
std::string extent_text(std::span<const int> size);

}  // namespace skybake::cli
