// Figures of ways that were measured before, in a cache.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "bakers/plan/plan_sky.h"
#include "config/diagnostics/diagnostic.h"

namespace skybake {

// Fills in the figures of all ways from the cache. Returns false if it has none under this key, which
// must tell all that the figures depend on.
bool find_figures(const std::filesystem::path& cache, const std::string& key,
                  std::vector<MeasuredWay>& ways);

// Keeps the figures. W0301 if the cache cannot be written; a plan goes on without it.
std::vector<config::Diagnostic> keep_figures(const std::filesystem::path& cache,
                                             const std::string& key,
                                             const std::vector<MeasuredWay>& ways);

}  // namespace skybake
