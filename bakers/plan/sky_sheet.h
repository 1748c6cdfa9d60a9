// A sheet of pictures: the sky by paths of light, and what each family of ways makes of it.
#pragma once

#include <string>
#include <vector>

#include "bakers/plan/bake_ways.h"
#include "bakers/plan/scene_views.h"
#include "bakers/plan/sky_ways.h"
#include "config/diagnostics/diagnostic.h"
#include "config/sections/parameters.h"

namespace skybake {

// Returns a PNG with a row for the truth and one for each of the skies. For up to three suns of the scene
// it has the sky, the sun in the middle and the horizon below, and its relative difference from the
// truth. `weights` are those of SceneTruth. Diagnostics are those of png_bytes. After an interruption
// the picture must not be used.
config::Outcome<std::string> sky_sheet(const config::Parameters& parameters,
                                       const SceneRange& range,
                                       const std::vector<BakedWay<SkyWay>>& skies,
                                       const std::vector<glm::dvec3>& weights,
                                       const BakeOptions& options);

}  // namespace skybake
