// The tables of Bruneton & Neyret 2008 as their implementation of 2017 has them (asset =
// "bruneton").
#pragma once

#include <string>
#include <vector>

#include "bakers/core/bake_options.h"
#include "bakers/core/volume.h"
#include "config/diagnostic.h"
#include "config/parameters.h"

namespace skybake {

// `volume` has its name, parameters and details. E0405: light that could not be solved for.
config::Outcome<BakedVolume> bake_bruneton(const config::Atmosphere& atmosphere,
                                           const config::BrunetonBake& bake,
                                           const BakeOptions& options, BakedVolume volume);

}  // namespace skybake
