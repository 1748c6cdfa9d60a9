// The tables with two axes: transmittance to the top of the air, and irradiance of level surfaces
// by the sky.
#pragma once

#include <vector>

#include "bakers/air/ray.h"
#include "bakers/field/table_model.h"
#include "bakers/light/sky_light.h"
#include "bakers/math/bake_options.h"
#include "config/assets/bruneton.h"
#include "config/diagnostics/diagnostic.h"

namespace skybake {

struct Baked;

// Returns the table of irradiance by the orders of `light`, over (mu_s + 1) / 2 and the share of the
// air's thickness. `light` and `solar_irradiance` must outlive it.
TableModel flat_irradiance(const SkyLight& light, const std::vector<double>& solar_irradiance);

// Bakes the transmittance. `volume` comes with name, parameters, details and channels; takram's has
// a channel A of 1.
Outcome<Baked> bake_bruneton_transmittance(const TableModel& table, const Shell& shell,
                                           const BrunetonBake& bake, const BakeOptions& options,
                                           Baked volume);

// Bakes the irradiance.
Outcome<Baked> bake_bruneton_irradiance(const TableModel& table, const Shell& shell,
                                        const BrunetonBake& bake, const BakeOptions& options,
                                        Baked volume);

}  // namespace skybake
