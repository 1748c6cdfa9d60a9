// Figures of ways that were measured before, in a cache.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "bakers/plan/way.h"
#include "config/diagnostics/diagnostic.h"

namespace skybake {

// Fills in a plan's figures and its sheet from the cache. Returns false if it has none under this key,
// which must tell all that they depend on.
bool find_figures(const std::filesystem::path& cache, const std::string& key, MeasuredWays& plan);

// Keeps them. W0301 if the cache cannot be written; a plan goes on without it.
std::vector<Diagnostic> keep_figures(const std::filesystem::path& cache, const std::string& key,
                                     const MeasuredWays& plan);

}  // namespace skybake
