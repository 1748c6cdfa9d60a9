// The table of asset = "forward_scattering": factors of small_angles.h over angle and optical depth
// (march/forward_mapping.h).
#pragma once

#include "bakers/assets/forward_scattering/small_angles.h"
#include "bakers/field/table_model.h"
#include "bakers/march/forward_mapping.h"
#include "bakers/math/bake_options.h"
#include "config/assets/forward_scattering.h"
#include "config/diagnostics/diagnostic.h"

namespace skybake {
struct Baked;
}  // namespace skybake

namespace skybake::forward_scattering {

// 0 <= x <= 1.
ScatteringAngle angle_at(double x);
// The coordinate of an angle in degrees.
double angle_coordinate(double degrees);

SmallAngles small_angles_of(const config::ForwardScatteringBake& bake);

// Errors are absolute: shares of the light of which factors are, that is scattered once. `light` must
// outlive the model.
TableModel forward_model(const SmallAngles& light);

// `table` comes labelled. Errors are those of finish_table.
Outcome<Baked> bake_forward_scattering(const config::ForwardScatteringBake& bake,
                                       const BakeOptions& options, Baked table);

}  // namespace skybake::forward_scattering
