// Path-traced skies in files: tracing takes a minute, reading none.
//
// A CSV as of reference/sky_truth.h. Its first line holds the key of what was traced and a
// fingerprint of the lines below it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "bakers/light/path_tracer/sky_truth.h"
#include "config/recipe/recipe.h"

namespace skybake {

// What a truth is of: equal keys, equal values. xxh3_hex of air, ground, directions, paths and
// kSkyTruthVersion.
std::string sky_truth_key(const config::Recipe& recipe,
                          const std::vector<SkyTruthDirection>& directions,
                          std::int64_t mean_paths);

std::string stored_sky_truth(const std::vector<SkyTruth>& truth, const std::string& key);

// Whether a text begins as one that is stored.
bool is_stored_sky_truth(std::string_view text);

// None where the text is of another key, damaged or cut short.
std::optional<std::vector<SkyTruth>> parse_stored_sky_truth(std::string_view text,
                                                            const std::string& key);

// The same of a file; none where it cannot be read.
std::optional<std::vector<SkyTruth>> load_sky_truth(const std::filesystem::path& path,
                                                    const std::string& key);

// Where a cache of assets keeps the truth of a key.
std::filesystem::path cached_sky_truth_path(const std::filesystem::path& cache,
                                            const std::string& key);

}  // namespace skybake
