// The index of a sweep's folder, as a preview looks at it.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "bakers/field/baked.h"
#include "config/diagnostics/diagnostic.h"

namespace skybake {

// A value that varies: as it is written, and as a number to sort by where it is one, in base units
// ("8 km" is 8000).
struct SweptValue {
    std::string text;
    std::optional<double> number;
};

struct SweepVariant {
    std::string name;                                   // of its folder
    std::string status;                                 // "done", "failed", "missing"
    std::vector<SweptValue> values;                     // as PreviewSweep::names
    std::map<std::string, ErrorFigures> lookup_errors;  // by the asset's name
};

struct PreviewSweep {
    std::string title;
    std::vector<std::string> names;   // of what varies: "ground_albedo"
    std::vector<std::string> assets;  // those with a measured error, in the order of the bake
    std::vector<SweepVariant> variants;
};

// Whether the folder is one of a sweep.
bool is_sweep_folder(const std::filesystem::path& folder);

// E0300, E0304 where sweep.json cannot be read or is damaged, of another tool, or names folders
// outside of its own.
config::Outcome<PreviewSweep> load_sweep(const std::filesystem::path& folder);

}  // namespace skybake
