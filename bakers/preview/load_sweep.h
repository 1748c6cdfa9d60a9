// Reads the index of a sweep's folder, and its times, for a preview.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "config/diagnostics/diagnostic.h"

namespace skybake {

// A value that varies: its text and, if it is a number, the number in base units for sorting ("8
// km" is 8000).
struct SweptValue {
    std::string text;
    std::optional<double> number;
};

// The figures that a sweep measured, by its column in index.csv ("sky_median", "lookup_rms", "bytes")
// and in timing.csv ("texels_s"). It is without figures that were not measured.
using SweptFigures = std::map<std::string, double, std::less<>>;

struct SweepVariant {
    int index = 0;
    std::string name;                             // name of its folder
    std::string status;                           // "done", "failed", "missing"
    std::vector<SweptValue> values;               // in the order of PreviewSweep::names
    std::map<std::string, SweptFigures> figures;  // by the asset's name
};

struct PreviewSweep {
    std::vector<std::string> names;  // names of what varies: "ground_albedo"
    // The labels of the values along each axis: "coverage 0.2", or "coverage 0.2, seed 1" of keys in
    // lockstep. Variants are the cross product, the last axis varying fastest.
    std::vector<std::vector<std::string>> axes;
    std::vector<std::string> assets;  // in the order of the bake
    std::vector<SweepVariant> variants;

    // Returns the place of a variant along an axis.
    std::size_t place(const SweepVariant& variant, std::size_t axis) const;
    // Returns the label of a variant along the axes from `first` on: "coverage 0.2, seed 1".
    std::string label(const SweepVariant& variant, std::size_t first = 0) const;
};

// Returns a figure of an asset, or nothing if it was not measured.
std::optional<double> figure_of(const SweepVariant& variant, const std::string& asset,
                                std::string_view figure);

// Whether the folder is that of a sweep.
bool is_sweep_folder(const std::filesystem::path& folder);

// Loads a sweep's index. E0300 if sweep.json cannot be read; E0304 if it is damaged, is of another
// tool or format, or names folders outside of its own. Without timing.csv there are no times.
Outcome<PreviewSweep> load_sweep(const std::filesystem::path& folder);

}  // namespace skybake
