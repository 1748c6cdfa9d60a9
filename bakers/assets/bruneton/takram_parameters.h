// The parameters of @takram/three-atmosphere that go with its tables.
#pragma once

#include <string>

#include "config/assets/bruneton.h"
#include "config/sections/atmosphere.h"

namespace skybake {

// A JSON object with those members of its AtmosphereParameters that tables depend on, under their
// names and in their units: radii in metres, coefficients per km, profiles over altitude in km,
// vectors as arrays. The atmosphere has no problem (config/assets/takram_layers.h).
std::string takram_parameters(const config::Atmosphere& atmosphere,
                              const config::BrunetonBake& bake);

}  // namespace skybake
