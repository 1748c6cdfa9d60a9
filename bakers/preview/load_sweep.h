// Reads the index of a sweep's folder for a preview.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "bakers/field/baked.h"
#include "config/diagnostics/diagnostic.h"

namespace skybake {

// A value that varies: its text and, if it is a number, the number in base units for sorting ("8
// km" is 8000).
struct SweptValue {
    std::string text;
    std::optional<double> number;
};

struct SweepVariant {
    std::string name;                                   // name of its folder
    std::string status;                                 // "done", "failed", "missing"
    std::vector<SweptValue> values;                     // in the order of PreviewSweep::names
    std::map<std::string, ErrorFigures> lookup_errors;  // by the asset's name
};

struct PreviewSweep {
    std::string title;
    std::vector<std::string> names;   // names of what varies: "ground_albedo"
    std::vector<std::string> assets;  // assets with a measured error, in the order of the bake
    std::vector<SweepVariant> variants;
};

// Whether the folder is that of a sweep.
bool is_sweep_folder(const std::filesystem::path& folder);

// Loads a sweep's index. E0300 if sweep.json cannot be read; E0304 if it is damaged, is of another
// tool, or names folders outside of its own.
config::Outcome<PreviewSweep> load_sweep(const std::filesystem::path& folder);

}  // namespace skybake
