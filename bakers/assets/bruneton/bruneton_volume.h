// The tables of Bruneton & Neyret 2008 as their implementation of 2017 has them (asset =
// "bruneton").
#pragma once

#include <optional>
#include <string>

#include "bakers/field/baked.h"
#include "bakers/light/solver/solve_light.h"
#include "bakers/math/bake_options.h"
#include "config/assets/bruneton.h"
#include "config/diagnostics/diagnostic.h"
#include "config/sections/atmosphere.h"

namespace skybake {

// `volume` has its name, parameters and details. E0405: light that could not be solved for.
config::Outcome<Baked> bake_bruneton(const config::Atmosphere& atmosphere,
                                     const config::BrunetonBake& bake, const BakeOptions& options,
                                     Baked volume);

// How the light is solved for that is scattered once more to make orders 2 and up; none where a
// table has none of these.
std::optional<SolverSettings> light_settings(const config::BrunetonBake& bake);

// The parameters of @takram/three-atmosphere that go with its tables.

// A JSON object with those members of its AtmosphereParameters that tables depend on, under their
// names and in their units: radii in metres, coefficients per km, profiles over altitude in km,
// vectors as arrays. The atmosphere has no problem (config/assets/takram_layers.h).
std::string takram_parameters(const config::Atmosphere& atmosphere,
                              const config::BrunetonBake& bake);

}  // namespace skybake
