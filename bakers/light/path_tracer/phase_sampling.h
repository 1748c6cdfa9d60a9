// Directions distributed as a phase function scatters them.
#pragma once

#include <cmath>

#include "bakers/air/particles/phase_function.h"
#include "bakers/light/path_tracer/path_numbers.h"
#include "bakers/math/vectors.h"

namespace skybake {

// True of Rayleigh's distribution and the like.
inline bool is_quadratic(const PhaseFunction& phase) {
    return !phase.table && phase.g == 0 && phase.quadratic != 0;
}

// Draws a scattering angle. Its cosine nu has the density 2 pi p(nu).
//
// Henyey-Greenstein's distribution is inverted: with s uniform in (-1, 1) and D = 1 + g^2 - 2 g nu,
// D = ((1 - g^2) / (1 + g s))^2, hence
//   1 - nu = (D - (1 - g)^2) / 2 g = (1 - g)^2 (1 - s) (2 + g (1 + s)) / (2 (1 + g s)^2)
//   1 + nu = ((1 + g)^2 - D) / 2 g = (1 + g)^2 (1 + s) (2 - g (1 - s)) / (2 (1 + g s)^2),
// which are sums of terms of one sign for any g. Rayleigh's distribution, and any a + b nu^2 with g
// = 0, is a cubic that is inverted by Halley's method. Where g is not 0 the factor a + b nu^2 of
// phase_function.h is applied by rejection: a <= a + b nu^2 <= a + b, so that at least half of all
// trials are accepted where a = b. Tables are inverted cell by cell (tabulated_phase.h).
//
// `share` in [0, 1] is inverted where the distribution is; trials after the first take their
// numbers from `random`.
ScatteringAngle sample_phase(const PhaseFunction& phase, double share, RandomStream& random);

// Returns the angle to a surface's normal of a direction by Lambert's law, whose density is in
// proportion to the cosine. `share` is uniform in (0, 1).
inline ScatteringAngle lambert_angle(double share) {
    const double cosine = std::sqrt(share);
    return {(1 - share) / (1 + cosine), 1 + cosine};
}

// Returns a direction at that angle to `direction`, at an azimuth about it of `turn` in [0, 1]
// turns. The azimuth's origin is arbitrary.
glm::dvec3 scatter(const glm::dvec3& direction, const ScatteringAngle& cosine, double turn);

}  // namespace skybake
