// Figures of ways that were measured before, in a cache.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "bakers/plan/bake_ways.h"
#include "bakers/plan/way.h"
#include "config/diagnostics/diagnostic.h"

namespace skybake {

// Returns a key that tells all that the figures of ways depend on: what the recipe says and reads, its
// scene without the limits, the bakers, the assets, the ways, and `rest`.
std::string figures_key(const Recipe& recipe, std::vector<config::Read> reads,
                        const WayAssets& assets, const MeasuredWays& plan, const std::string& rest);

// Fills in a plan's figures and its sheet from the cache. Returns false if it has none under this key.
bool find_figures(const std::filesystem::path& cache, const std::string& key, MeasuredWays& plan);

// Keeps them. W0301 if the cache cannot be written; a plan goes on without it.
std::vector<Diagnostic> keep_figures(const std::filesystem::path& cache, const std::string& key,
                                     const MeasuredWays& plan);

}  // namespace skybake
