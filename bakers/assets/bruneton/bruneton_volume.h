// The tables of Bruneton & Neyret 2008 as in their implementation of 2017 (asset = "bruneton").
#pragma once

#include <glm/ext/vector_double3.hpp>
#include <string>
#include <vector>

#include "bakers/math/bake_options.h"
#include "bakers/math/intermediates.h"
#include "config/assets/bruneton.h"
#include "config/diagnostics/diagnostic.h"
#include "config/sections/atmosphere.h"

namespace skybake {

struct Baked;

// The air at the wavelengths that are computed together, and the weights of all of them: tables hold
// their colours, or the wavelengths of one packet without weights.
struct PacketsOfAir {
    std::vector<config::Atmosphere> packets;
    std::vector<glm::dvec3> weights = {};
};

// Bakes one table. `volume` comes with name, parameters and details. Returns E0405 if the light
// cannot be solved for.
Outcome<Baked> bake_bruneton(const PacketsOfAir& air, const BrunetonBake& bake,
                             const BakeOptions& options, Baked volume);

// Returns what the table of these packets is made from and shares with others: solved light, sunlight,
// and light that was scattered once or more often.
std::vector<Need> needs_of_bruneton(const std::vector<config::Atmosphere>& packets,
                                    const BrunetonBake& bake);

// Returns the parameters of @takram/three-atmosphere that belong to its tables: a JSON object with
// those members of its AtmosphereParameters on which tables depend, under their names and in their
// units: radii in metres, coefficients per km, profiles over altitude in km, vectors as arrays. The
// atmosphere must have no problem (config/assets/takram_layers.h). For colours, coefficients are those
// of sunlight through very little air, and the irradiance is the sun's colour.
std::string takram_parameters(const PacketsOfAir& air, const BrunetonBake& bake);

}  // namespace skybake
