// The baker of `asset = "irradiance"`.
#pragma once

#include "bakers/air/ray.h"
#include "bakers/assets/sky/sky_lights.h"
#include "bakers/field/table_model.h"
#include "bakers/light/sky_light.h"
#include "bakers/math/bake_options.h"
#include "config/assets/irradiance.h"
#include "config/diagnostics/diagnostic.h"
#include "config/sections/scene.h"

namespace skybake {

struct Baked;

// Convert between altitude and y = sqrt(altitude / thickness) in [0, 1]. Rows are densest at the
// ground, where most of the air is.
double irradiance_altitude_km(const Shell& shell, double y);
double irradiance_coordinate(const Shell& shell, double altitude_km);

// The table as a function: irradiance of a level surface at the sun's cosine of x, mapped as in
// multiple_scattering_mapping.h, and at the altitude of y. The reference is the same integral with
// more directions. `light` must outlive the model.
TableModel irradiance_model(const SkyLight& light, const config::IrradianceBake& bake);

// Returns the orders for which the light must be solved.
config::SkyOrders orders_of(const config::IrradianceBake& bake);

// Bakes the table. `table` comes with name, parameters and channel names.
Outcome<Baked> bake_irradiance(const SkyLights& lights, const config::IrradianceBake& bake,
                               const BakeOptions& options, Baked table);

}  // namespace skybake
