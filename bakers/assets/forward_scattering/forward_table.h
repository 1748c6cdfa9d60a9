// The table of asset = "forward_scattering": factors of small_angles.h over angle and optical depth.
//
//   x = sqrt(sin(angle / 2))     y = depth / (depth + kMiddleDepth) (1 + kMiddleDepth / kDeepest)
//
// x is 0 straight on and 1 straight back; y is 0 where the sun is not hidden and 1 at kDeepest.
#pragma once

#include "bakers/assets/forward_scattering/small_angles.h"
#include "bakers/field/table_model.h"
#include "bakers/math/bake_options.h"
#include "config/assets/forward_scattering.h"
#include "config/diagnostics/diagnostic.h"

namespace skybake {
struct Baked;
}  // namespace skybake

namespace skybake::forward_scattering {

// Half of the texels are for smaller depths.
inline constexpr double kMiddleDepth = 4;
// Where no sunlight is left: exp(-252 s) is below 1e-15 for the least s, 0.14 of degree 0.
inline constexpr double kDeepest = 252;

// 0 <= x <= 1.
ScatteringAngle angle_at(double x);
double depth_at(double y);
// The coordinates of an angle in degrees and of an optical depth.
double angle_coordinate(double degrees);
double depth_coordinate(double depth);

SmallAngles small_angles_of(const config::ForwardScatteringBake& bake);

// Errors are absolute: shares of the light of which factors are, that is scattered once. `light` must
// outlive the model.
TableModel forward_model(const SmallAngles& light);

// `table` comes labelled. Errors are those of finish_table.
config::Outcome<Baked> bake_forward_scattering(const config::ForwardScatteringBake& bake,
                                               const BakeOptions& options, Baked table);

}  // namespace skybake::forward_scattering
