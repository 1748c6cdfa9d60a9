// Traces skies with a given number of paths and stores them in files, because tracing takes a
// minute and reading takes almost no time.
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
// The relative error of direction i is s_i / sqrt(n_i) for n_i paths; s_i is a hundred times larger
// in deep twilight than by day. Equal n_i would leave twilight very noisy; n_i in proportion to
// s_i^2 would make all errors equally bad. n_i in proportion to s_i is a compromise: errors are
// proportional to sqrt(s_i).

// The version is part of the truth's key in a cache. Raise it whenever the same parameters give
// other values, here or in bakers/light/path_tracer.
inline constexpr int kSkyTruthVersion = 1;

// Traces `mean_paths` paths per direction on average, at least 2. In addition, pilot paths find
// s_i: a 16th of `mean_paths`, at most 4096. The bits are the same for any number of threads.
// Returns nothing if the user has interrupted.
std::optional<std::vector<SkyTruth>> trace_sky_truth_within(
    const SkyMedium& medium, const std::vector<SkyTruthDirection>& directions,
    std::int64_t mean_paths, int threads, Progress* progress);

// --- Storing ------------------------------------------------------------------------------------
//
// A stored truth is a CSV file as described in light/path_tracer/sky_truth.h. Its first line holds
// the truth's key and a fingerprint of the lines below.

// Returns the key of a truth: the xxh3_hex of air, ground, directions, paths and kSkyTruthVersion.
// Truths with equal keys have equal values.
std::string sky_truth_key(const config::Recipe& recipe,
                          const std::vector<SkyTruthDirection>& directions,
                          std::int64_t mean_paths);

std::string stored_sky_truth(const std::vector<SkyTruth>& truth, const std::string& key);

// Whether a text begins like that of a stored truth.
bool is_stored_sky_truth(std::string_view text);

// Parses a stored truth. Returns nothing if the text has another key, is damaged or is cut short.
std::optional<std::vector<SkyTruth>> parse_stored_sky_truth(std::string_view text,
                                                            const std::string& key);

// Does the same for a file. Returns nothing if it cannot be read.
std::optional<std::vector<SkyTruth>> load_sky_truth(const std::filesystem::path& path,
                                                    const std::string& key);

// Returns the path at which a cache of assets keeps the truth of a key.
std::filesystem::path cached_sky_truth_path(const std::filesystem::path& cache,
                                            const std::string& key);

}  // namespace skybake
