// The baker of `asset = "transmittance"`, and the baselines with which its kernel is compared.
#pragma once

#include <string>

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
config::Outcome<Baked> bake_transmittance(const Medium& medium,
                                          const config::TransmittanceBake& bake,
                                          const BakeOptions& options, Baked table);

// Optical depth by equal steps along the ray, as the papers and their samples compute it: the
// baselines to which figures of the exact kernel (optical_depth.h) are ratios.

// The place in a step of length L / n, with L the distance to the top, where its extinction is
// evaluated.
enum class StepRule {
    // At its end, where step i ends at (i + 0.3) L / n: the sample of Hillaire 2020, n = 40.
    // Density falls along most rays, so the result is too small. First order.
    end_point,
    // In its middle. Second order.
    midpoint,
    // The mean of its two ends: Bruneton & Neyret 2008, n = 500. Second order.
    trapezoid,
};

// Returns the optical depth from an altitude with s = r mu to the top of the atmosphere. The ray
// must not hit the ground. It takes one sample after the other, without vectors; steps >= 1.
Spectrum optical_depth_by_steps(const Medium& medium, double altitude_km, double s_km, int steps,
                                StepRule rule);

}  // namespace skybake
