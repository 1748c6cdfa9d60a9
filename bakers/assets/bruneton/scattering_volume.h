// The tables of four axes as volumes.
#pragma once

#include <memory>

#include "bakers/air/sky_medium.h"
#include "bakers/field/baked.h"
#include "bakers/light/solver/solved_light.h"
#include "bakers/math/bake_options.h"
#include "config/assets/bruneton.h"
#include "config/diagnostics/diagnostic.h"

namespace skybake {

// `volume` has its name, parameters, details and channels; without `light` there are no higher
// orders.
config::Outcome<Baked> bake_scattering(const SkyMedium& medium,
                                       const std::shared_ptr<const SolvedLight>& light,
                                       const config::BrunetonBake& bake, const BakeOptions& options,
                                       Baked volume);

}  // namespace skybake
