// Where multiple scattering stands in its table: u from the sun's cosine, v from altitude, both
// with end points on texel centres, u = 1/2N + x (1 - 1/N).
//
//   hillaire  x = (mu_s + 1) / 2                                the paper's, linear in the cosine
//   twilight  x = (1 + sign(mu_s) sqrt(|mu_s|)) / 2             spends its texels about the
//   terminator
//
// and y = altitude / thickness in both. Column 0 is mu_s = -1, row 0 the ground.
#pragma once

#include "config/sections/scene.h"

namespace skybake {

// The sun's cosine at a coordinate in [0, 1].
double sun_cos_zenith_at(config::MultipleScatteringMapping mapping, double x);

// The coordinate of a cosine in [-1, 1]; the inverse of the above within 1e-12.
double sun_coordinate(config::MultipleScatteringMapping mapping, double sun_cos_zenith);

}  // namespace skybake
