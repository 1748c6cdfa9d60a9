// The baker of `asset = "transmittance"`, and the baselines with which its kernel is compared.
#pragma once

#include "bakers/air/medium.h"
#include "bakers/field/table_model.h"
#include "bakers/math/bake_options.h"
#include "config/assets/transmittance.h"
#include "config/diagnostics/diagnostic.h"

namespace skybake {

struct Baked;

// The table as a function: transmittance, or optical depth, of the ray at (x_mu, x_r). The
// reference is optical_depth.h. `medium` must outlive the model.
TableModel transmittance_model(const Medium& medium, const config::TransmittanceBake& bake);

// Bakes the transmittance from a point to the top of the atmosphere (transmittance_mapping.h).
// `table` comes with name, parameters and channel names.
Outcome<Baked> bake_transmittance(const Medium& medium, const config::TransmittanceBake& bake,
                                  const BakeOptions& options, Baked table);

}  // namespace skybake
