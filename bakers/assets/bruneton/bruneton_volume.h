// The tables of Bruneton & Neyret 2008 as in their implementation of 2017 (asset = "bruneton").
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bakers/field/baked.h"
#include "bakers/light/solver/solve_light.h"
#include "bakers/math/bake_options.h"
#include "bakers/math/intermediates.h"
#include "config/assets/bruneton.h"
#include "config/diagnostics/diagnostic.h"
#include "config/sections/atmosphere.h"

namespace skybake {

// Bakes one table. `volume` comes with name, parameters and details. Returns E0405 if the light
// cannot be solved for.
config::Outcome<Baked> bake_bruneton(const config::Atmosphere& atmosphere,
                                     const config::BrunetonBake& bake, const BakeOptions& options,
                                     Baked volume);

// Returns what a table is made from and shares with others: solved light, sunlight, and light that
// was scattered once or more often.
std::vector<Need> needs_of_bruneton(const config::Atmosphere& atmosphere,
                                    const config::BrunetonBake& bake);

// Returns the settings that solve for the light which is scattered once more to make orders 2 and
// up; nothing if a table has none of these orders.
std::optional<SolverSettings> light_settings(const SkyMedium& medium,
                                             const config::BrunetonBake& bake);

// Returns the parameters of @takram/three-atmosphere that belong to its tables: a JSON object with
// those members of its AtmosphereParameters on which tables depend, under their names and in their
// units: radii in metres, coefficients per km, profiles over altitude in km, vectors as arrays. The
// atmosphere must have no problem (config/assets/takram_layers.h).
std::string takram_parameters(const config::Atmosphere& atmosphere,
                              const config::BrunetonBake& bake);

}  // namespace skybake
