#include "bakers/render/droplet_phase.h"

#include <cmath>
#include <numbers>

#include "bakers/math/transcendental.h"

namespace skybake {

namespace {

// 1 + g^2 - 2 g u = (1 - g)^2 + 2 g (1 - u), without cancellation.
double henyey_greenstein(double g, double offset) {
    const double base = (1 - g) * (1 - g) + 2 * g * offset;
    return (1 - g) * (1 + g) / (4 * std::numbers::pi * base * std::sqrt(base));
}

}  // namespace

DropletPhase droplet_phase(double diameter_um) {
    const double d = diameter_um;
    return {exponential(-0.0990567 / (d - 1.67154)),
            exponential(-2.20679 / (d + 3.91029) - 0.428934),
            exponential(3.62489 - 8.29288 / (d + 5.52825)),
            exponential(-0.599085 / (d - 0.641583) - 0.665888)};
}

DropletPhase widened(const DropletPhase& phase, double eccentricity) {
    return {phase.hg_g * eccentricity, phase.draine_g * eccentricity,
            phase.draine_alpha * eccentricity, phase.draine_share};
}

double phase_value(const DropletPhase& phase, double offset) {
    const double u = 1 - offset;
    const double g = phase.draine_g;
    const double alpha = phase.draine_alpha;
    const double draine =
        henyey_greenstein(g, offset) * (1 + alpha * u * u) / (1 + alpha * (1 + 2 * g * g) / 3);
    return (1 - phase.draine_share) * henyey_greenstein(phase.hg_g, offset) +
           phase.draine_share * draine;
}

// Draine's, by the moments 1, g and (1 + 2 g^2) / 3, (3 g + 2 g^3) / 5 of u, u^2 and u^3 under
// Henyey-Greenstein's.
double mean_cosine(const DropletPhase& phase) {
    const double g = phase.draine_g;
    const double alpha = phase.draine_alpha;
    const double draine = g * (1 + alpha * (3 + 2 * g * g) / 5) / (1 + alpha * (1 + 2 * g * g) / 3);
    return (1 - phase.draine_share) * phase.hg_g + phase.draine_share * draine;
}

}  // namespace skybake
