#include "bakers/air/particles/phase_function.h"

#include <cassert>
#include <cstddef>
#include <numbers>

#include "bakers/air/particles/phase_function-inl.h"
#include "config/sections/layer.h"

namespace skybake {

PhaseFunction make_phase_function(config::Phase phase, double g) {
    constexpr double kPi = std::numbers::pi;
    switch (phase) {
        case config::Phase::isotropic:
            return {1 / (4 * kPi), 0, 0};
        case config::Phase::rayleigh:
            return make_rayleigh_phase(0);
        case config::Phase::henyey_greenstein:
            return {(1 - g) * (1 + g) / (4 * kPi), 0, g};
        case config::Phase::cornette_shanks:
        case config::Phase::mie:
            break;
    }
    const double factor = 3 * (1 - g) * (1 + g) / (8 * kPi * (2 + g * g));
    return {factor, factor, g};
}

PhaseFunction make_rayleigh_phase(double depolarization) {
    const double gamma = depolarization / (2 - depolarization);
    const double factor = 3 / (16 * std::numbers::pi * (1 + 2 * gamma));
    return {factor * (1 + 3 * gamma), factor * (1 - gamma), 0};
}

double phase_value(const PhaseFunction& phase, double one_minus_cosine, double one_plus_cosine) {
    if (phase.table) return tabulated_phase_value(*phase.table, one_minus_cosine, one_plus_cosine);
    return HWY_NAMESPACE::closed_phase_value(phase.constant, phase.quadratic, phase.g,
                                             one_minus_cosine, one_plus_cosine);
}

double henyey_greenstein(double g, double one_minus_cosine, double one_plus_cosine) {
    return std::numbers::inv_pi / 4 * (1 - g) * (1 + g) /
           HWY_NAMESPACE::henyey_greenstein_denominator(g, one_minus_cosine, one_plus_cosine);
}

double draine(double g, double alpha, double one_minus_cosine, double one_plus_cosine) {
    const double nu = 0.5 * (one_plus_cosine - one_minus_cosine);
    return henyey_greenstein(g, one_minus_cosine, one_plus_cosine) * (1 + alpha * nu * nu) /
           (1 + alpha * (1 + 2 * g * g) / 3);
}

double rayleigh_phase(double nu) { return 3 / (16 * std::numbers::pi) * (1 + nu * nu); }

std::vector<double> legendre_moments(const PhaseFunction& phase, int degree) {
    assert(degree >= 0);
    if (phase.table) return tabulated_moments(*phase.table, degree);
    const double g = phase.g;
    // g^l of degrees up to degree + 2.
    std::vector<double> powers = {1};
    for (int l = 1; l <= degree + 2; ++l) powers.push_back(powers.back() * g);
    // p = (a + b nu^2) 4 pi / (1 - g^2) times Henyey-Greenstein's.
    const double factor = 4 * std::numbers::pi / ((1 - g) * (1 + g));
    std::vector<double> moments;
    for (int l = 0; l <= degree; ++l) {
        const double n = l;
        // nu^2 P_l = up P_(l+2) + same P_l + down P_(l-2), nu P_l = ((l+1) P_(l+1) + l P_(l-1)) /
        // (2 l + 1) twice.
        const double up = (n + 1) * (n + 2) / ((2 * n + 1) * (2 * n + 3));
        const double same =
            (n + 1) * (n + 1) / ((2 * n + 1) * (2 * n + 3)) + n * n / ((2 * n + 1) * (2 * n - 1));
        const double down = n * (n - 1) / ((2 * n + 1) * (2 * n - 1));
        const auto i = static_cast<std::size_t>(l);
        const double squared =
            up * powers[i + 2] + same * powers[i] + (l >= 2 ? down * powers[i - 2] : 0.0);
        moments.push_back(factor * (phase.constant * powers[i] + phase.quadratic * squared));
    }
    return moments;
}

}  // namespace skybake
