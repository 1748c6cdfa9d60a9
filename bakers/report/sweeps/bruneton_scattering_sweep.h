// The variants of Bruneton's tables of scattering, of single Mie scattering and of higher orders.
#pragma once

#include <optional>

#include "bakers/report/report.h"
#include "bakers/report/sweeps/bruneton_sweep.h"
#include "config/assets/bruneton.h"
#include "config/sections/atmosphere.h"

namespace skybake {

// As asked, half and a quarter of that along each axis but nu, as float and half:
//
//   solved, fitted   as `bake` has it
//   solved, exact    texels before they are moved for lookups (bruneton/lookup_fit.h)
//   iterated         2, 3 and 4 orders as Bruneton iterates them, at the smallest size alone: it
//                    takes seconds there, minutes at the size of the published tables
//
// All are measured against the orders that the recipe asks for, as its certificate is. None: the
// user has interrupted.
std::optional<BrunetonSweep> bruneton_scattering_sweep(const config::Atmosphere& atmosphere,
                                                       const config::BrunetonBake& asked,
                                                       const ReportOptions& options);

}  // namespace skybake
