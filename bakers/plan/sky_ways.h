// The ways in which a runtime may draw a clear sky, each with the assets that it needs.
#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "config/sections/scene.h"

namespace skybake {

// One asset of a way, as a recipe has it.
struct WayAsset {
    std::string name;                                       // of its section in a written recipe
    std::vector<std::pair<std::string, std::string>> keys;  // and their values as TOML
    bool operator==(const WayAsset&) const = default;
};

struct SkyWay {
    config::SkyBy by = config::SkyBy::march;
    std::string family;    // "moments of degree 4"
    std::string name;      // what it differs in from others of the family: "32x32, half, 16 steps"
    std::string baseline;  // whose published method it is; or empty
    std::vector<WayAsset> assets;
    int steps = 0;  // of a march
};

// A sky view has a table for each of at most so many suns.
inline constexpr std::size_t kMostViewedSuns = 4;

// Returns all ways that `by` allows; empty: all. Pictures need suns, whose elevations are
// `suns` as TOML, and a camera; they are left out if there are none or more than kMostViewedSuns.
std::vector<SkyWay> sky_ways(const std::vector<config::SkyBy>& by,
                             const std::vector<std::string>& suns, const std::string& camera);

}  // namespace skybake
