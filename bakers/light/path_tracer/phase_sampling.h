// Directions distributed as a phase function scatters them.
#pragma once

#include "bakers/air/particles/phase_function.h"
#include "bakers/light/path_tracer/random_numbers.h"
#include "bakers/math/vectors.h"

namespace skybake {

// nu with density 2 pi p(nu).
//
// Henyey-Greenstein's distribution is inverted: with s uniform in (-1, 1) and D = 1 + g^2 - 2 g nu,
// D = ((1 - g^2) / (1 + g s))^2, hence
//   1 - nu = (D - (1 - g)^2) / 2 g = (1 - g)^2 (1 - s) (2 + g (1 + s)) / (2 (1 + g s)^2)
//   1 + nu = ((1 + g)^2 - D) / 2 g = (1 + g)^2 (1 + s) (2 - g (1 - s)) / (2 (1 + g s)^2),
// sums of terms of one sign for any g. The factor a + b nu^2 of phase_function.h follows by
// rejection; a <= a + b nu^2 <= a + b, so that at least half of all trials pass where a = b. Tables
// are inverted cell by cell (tabulated_phase.h).
ScatteringAngle sample_phase(const PhaseFunction& phase, RandomStream& random);

// The direction at that angle to `direction`, the azimuth about it uniform.
glm::dvec3 scatter(const glm::dvec3& direction, const ScatteringAngle& cosine,
                   RandomStream& random);

}  // namespace skybake
