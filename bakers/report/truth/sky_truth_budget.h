// Path-traced skies for a given number of paths, spent where they count.
//
// The relative error of direction i falls as s_i / sqrt(n_i) with its paths n_i; s_i is a hundred
// times larger in deep twilight than by day. Even shares leave twilight in noise, shares of s_i^2
// leave all of it equally bad. n_i in proportion to s_i lies between: errors differ by sqrt(s_i).
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "bakers/air/sky_medium.h"
#include "bakers/light/path_tracer/sky_truth.h"
#include "bakers/math/progress.h"

namespace skybake {

// Counts as part of the truth's key in a cache: to be raised whenever the same parameters give
// other values, here or in bakers/light/path_tracer.
inline constexpr int kSkyTruthVersion = 1;

// `mean_paths` a direction, at least 2; pilot paths, which find s_i, come on top: a 16th of them,
// at most 4096. The same bits for any number of threads. None: the user has interrupted.
std::optional<std::vector<SkyTruth>> trace_sky_truth_within(
    const SkyMedium& medium, const std::vector<SkyTruthDirection>& directions,
    std::int64_t mean_paths, int threads, Progress* progress);

}  // namespace skybake
