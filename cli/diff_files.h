// Compares two baked files, or the files of two folders, for `diff`.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "bakers/io/manifest/compare.h"
#include "bakers/math/bake_options.h"
#include "config/diagnostics/diagnostic.h"

namespace skybake::cli {

// These are two files with the same name, or one file without a counterpart.
struct FileDifference {
    std::string name;
    std::string only_in;  // the only folder that has it; empty if both have it
    ImageDifference image;
};

struct Comparison {
    std::vector<FileDifference> files;
    std::vector<Diagnostic> diagnostics;
};

// Reports E0001 for a file and a folder, E0300 for a folder without baked files, and the diagnostics
// of those who read and compare files. `progress` hears of the share of a folder's bytes.
Comparison compare(const std::filesystem::path& first, const std::filesystem::path& second,
                   Progress& progress);

}  // namespace skybake::cli
