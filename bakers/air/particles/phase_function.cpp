#include "bakers/air/particles/phase_function.h"

#include <cmath>
#include <numbers>

namespace skybake {

PhaseFunction make_phase_function(config::Phase phase, double g) {
    constexpr double kPi = std::numbers::pi;
    switch (phase) {
        case config::Phase::isotropic:
            return {1 / (4 * kPi), 0, 0};
        case config::Phase::rayleigh:
            return {3 / (16 * kPi), 3 / (16 * kPi), 0};
        case config::Phase::henyey_greenstein:
            return {(1 - g) * (1 + g) / (4 * kPi), 0, g};
        case config::Phase::cornette_shanks:
        case config::Phase::mie:
            break;
    }
    const double factor = 3 * (1 - g) * (1 + g) / (8 * kPi * (2 + g * g));
    return {factor, factor, g};
}

double phase_value(const PhaseFunction& phase, double one_minus_cosine, double one_plus_cosine) {
    if (phase.table) return tabulated_phase_value(*phase.table, one_minus_cosine, one_plus_cosine);
    const double g = std::fabs(phase.g);
    const double apart = phase.g < 0 ? one_plus_cosine : one_minus_cosine;
    const double denominator = (1 - g) * (1 - g) + 2 * g * apart;
    const double cosine = 0.5 * (one_plus_cosine - one_minus_cosine);
    return (phase.constant + phase.quadratic * cosine * cosine) /
           (denominator * std::sqrt(denominator));
}

}  // namespace skybake
