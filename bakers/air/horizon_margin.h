// How near the horizon a probe may look: there rounding decides whether a runtime sees the ground.
#pragma once

#include <numbers>

#include "bakers/air/ray.h"
#include "bakers/math/transcendental.h"

namespace skybake {

inline constexpr double kHorizonMargin = 0.01 * std::numbers::pi / 180;  // radians

// s = r mu of the rays at this angle above the horizon and at the same angle below it. With the
// horizon's dip below the horizontal, cos dip = R / r and sin dip = rho / r,
// s = r sin(+-angle - dip).
inline double lowest_s_of_sky_km(const Shell& shell, double altitude_km) {
    const SineCosine margin = sine_and_cosine(kHorizonMargin);
    return shell.ground_radius_km * margin.sine -
           horizon_distance_km(shell, altitude_km) * margin.cosine;
}
inline double highest_s_of_ground_km(const Shell& shell, double altitude_km) {
    const SineCosine margin = sine_and_cosine(kHorizonMargin);
    return -shell.ground_radius_km * margin.sine -
           horizon_distance_km(shell, altitude_km) * margin.cosine;
}

}  // namespace skybake
