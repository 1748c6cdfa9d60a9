// Values of tabulated phase functions.
#pragma once

#include <cmath>
#include <numbers>

#include "bakers/air/particles/tabulated_phase.h"

namespace skybake {

inline double value_at(const TabulatedPhase& phase, double degrees) {
    const double half = degrees * std::numbers::pi / 360;
    return tabulated_phase_value(phase, 2 * std::sin(half) * std::sin(half),
                                 2 * std::cos(half) * std::cos(half));
}

}  // namespace skybake
