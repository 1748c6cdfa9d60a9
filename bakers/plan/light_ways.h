// The ways in which a runtime may draw the light of clear air.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "bakers/field/choose_probes.h"
#include "bakers/plan/choose_way.h"
#include "bakers/plan/light_truth.h"
#include "config/sections/parameters.h"
#include "config/sections/scene.h"

namespace skybake {

// One lookup: the number of an asset among those of a way, and the coordinates.
struct Reading {
    std::size_t asset = 0;
    Place at;
};

struct LightWay : Way {
    config::SkyBy how = config::SkyBy::march;
    std::function<Reading(const LightView& view)> reads;  // for pictures
};

// Pictures of a sky have a table, or a file, for each of at most so many suns.
inline constexpr std::size_t kMostViewedSuns = 4;

// Whether a scene's suns can have pictures.
bool has_viewed_suns(const SceneRange& range);

// Returns the ways to draw a part of the light. `sky_by` of the scene is for the sky and the air before
// things; surroundings are pictures, and the light on the ground is a table. Tables that are marched
// have at most kMaxChannels wavelengths.
std::vector<LightWay> light_ways(config::Draws light, const Parameters& parameters,
                                 const SceneRange& range);

}  // namespace skybake
