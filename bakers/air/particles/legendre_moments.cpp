#include "bakers/air/particles/legendre_moments.h"

#include <cstddef>
#include <numbers>

namespace skybake {

std::vector<double> legendre_moments(const PhaseFunction& phase, int degree) {
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
