// The files that a sweep leaves beside its variants: index.csv for spreadsheets and index.jsonl for
// programs, with one row per variant, and sweep.json, which says what was asked for. Runs with the
// same results give the same bytes, whether they run whole or in shards. Only the fourth file,
// timing.csv, changes from run to run.
#pragma once

#include <array>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "bakers/workspace/sweep/variants.h"
#include "config/diagnostics/diagnostic.h"
#include "config/sweep/sweep.h"

namespace skybake {

inline constexpr std::string_view sweep_manifest_name = "sweep.json";
inline constexpr std::string_view sweep_timing_name = "timing.csv";
inline constexpr std::array<std::string_view, 4> index_names = {
    "index.csv", "index.jsonl", sweep_manifest_name, sweep_timing_name};
inline constexpr int sweep_format = 2;  // of sweep.json

// Returns one line per variant, in the format of RFC 4180 except for its line ends: index, name,
// what varies, status, the first error, and the errors, bytes, content hash and files of each asset.
std::string index_csv(const config::Sweep& sweep, std::span<const VariantResult> variants);

// Returns the same as one JSON object per line.
std::string index_jsonl(const config::Sweep& sweep, std::span<const VariantResult> variants);

// Returns the text of sweep.json. sweep_schema.json defines its form, and below $defs/variant that of a line of
// index.jsonl.
std::string sweep_json(const config::Sweep& sweep, std::span<const VariantResult> variants);

// Returns one line for each asset of each variant that is done: the variant's index, the asset, the
// wall times in seconds of the bake that made it, and the variant's name. A copy has the times of the
// asset that it is a copy of.
std::string timing_csv(std::span<const VariantResult> variants);

// Checks whether a sweep may be written into the folder. E0302 and E0303 as for
// inspect_output_folder; E0303 also if the folder holds a bake. If the folder has a sweep.json of
// skybake, all four files are skybake's.
[[nodiscard]] std::vector<Diagnostic> inspect_index(const std::filesystem::path& folder,
                                                    bool force);

// Writes all four files, or none of them. E0301, E0302.
[[nodiscard]] std::vector<Diagnostic> write_index(const std::filesystem::path& folder,
                                                  const config::Sweep& sweep,
                                                  std::span<const VariantResult> variants);

}  // namespace skybake
