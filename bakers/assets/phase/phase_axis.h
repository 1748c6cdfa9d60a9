// Which scattering angle a texel of a phase table stands for: x in [0, 1] from straight on to
// straight back.
//
//   angle    theta = pi x
//   cosine   cos theta = 1 - 2 x
//   peaks    1 - cos theta = (2 x)^4 up to 90 degrees, 1 + cos theta = (2 - 2 x)^4 beyond: about
//            uniform in the square root of the angle from either pole
#pragma once

#include "bakers/air/particles/tabulated_phase.h"
#include "config/assets/phase.h"

namespace skybake {

// For any spacing but `best`.
ScatteringAngle scattering_angle(config::PhaseSpacing spacing, double x);
double phase_coordinate(config::PhaseSpacing spacing, const ScatteringAngle& angle);

// The angle itself, in [0, pi].
double radians(const ScatteringAngle& angle);

}  // namespace skybake
