// Path-traced skies, for a given number of paths, and their files: tracing takes a minute, reading
// none.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "bakers/air/medium.h"
#include "bakers/light/path_tracer/sky_truth.h"
#include "bakers/math/bake_options.h"
#include "config/recipe/recipe.h"

namespace skybake {

// --- Tracing ------------------------------------------------------------------------------------
//
// The relative error of direction i falls as s_i / sqrt(n_i) with its paths n_i; s_i is a hundred
// times larger in deep twilight than by day. Even shares leave twilight in noise, shares of s_i^2
// leave all of it equally bad. n_i in proportion to s_i lies between: errors differ by sqrt(s_i).

// Counts as part of the truth's key in a cache: to be raised whenever the same parameters give
// other values, here or in bakers/light/path_tracer.
inline constexpr int kSkyTruthVersion = 1;

// `mean_paths` per direction, at least 2; pilot paths, which find s_i, come on top: a 16th of them,
// at most 4096. The same bits for any number of threads. None: the user has interrupted.
std::optional<std::vector<SkyTruth>> trace_sky_truth_within(
    const SkyMedium& medium, const std::vector<SkyTruthDirection>& directions,
    std::int64_t mean_paths, int threads, Progress* progress);

// --- Storing ------------------------------------------------------------------------------------
//
// A CSV as of light/path_tracer/sky_truth.h. Its first line holds the key of what was traced and a
// fingerprint of the lines below it.

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
