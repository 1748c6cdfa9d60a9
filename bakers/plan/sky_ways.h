// The ways in which a runtime may draw a clear sky.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "bakers/plan/way.h"
#include "config/sections/scene.h"

namespace skybake {

struct SkyWay : Way {
    config::SkyBy how = config::SkyBy::march;
};

// A sky view has a table for each of at most so many suns.
inline constexpr std::size_t kMostViewedSuns = 4;

// Returns all ways that `by` allows; empty: all. Pictures need suns, whose elevations are
// `suns` as TOML, and a camera; they are left out if there are none or more than kMostViewedSuns.
std::vector<SkyWay> sky_ways(const std::vector<config::SkyBy>& by,
                             const std::vector<std::string>& suns, const std::string& camera);

}  // namespace skybake
