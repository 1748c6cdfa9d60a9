// What a sweep leaves beside its variants: index.csv and index.jsonl, a row for each, for tables
// and programs, and sweep.json, which says what was asked for. The same bytes from every run that
// comes to the same results, whole or in shards.
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
inline constexpr std::array<std::string_view, 3> index_names = {"index.csv", "index.jsonl",
                                                                sweep_manifest_name};

// One line a variant, RFC 4180 but for its line ends: index, name, what varies, status, the first
// error, and of each asset its errors, content hash and files.
std::string index_csv(const config::Sweep& sweep, std::span<const VariantResult> variants);

// The same as one JSON object a line.
std::string index_jsonl(const config::Sweep& sweep, std::span<const VariantResult> variants);

// The form of it is sweep_schema.json.
std::string sweep_json(const config::Sweep& sweep, std::span<const VariantResult> variants);

// The JSON Schemas of sweep.json, and of a line of index.jsonl below $defs/variant.
std::string_view sweep_schema();

// Whether the index may be written there: E0302, E0303 as inspect_output_folder. A folder with a
// sweep.json of skybake's claims all three.
[[nodiscard]] std::vector<config::Diagnostic> inspect_index(const std::filesystem::path& folder,
                                                            bool force);

// Writes the three, all or none of them. E0301, E0302.
[[nodiscard]] std::vector<config::Diagnostic> write_index(const std::filesystem::path& folder,
                                                          const config::Sweep& sweep,
                                                          std::span<const VariantResult> variants);

}  // namespace skybake
