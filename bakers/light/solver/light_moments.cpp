#include "bakers/light/solver/light_moments.h"

#include <numbers>

namespace skybake {

namespace {

void harmonics(int degree, double mu, double sine, double* values) {
    // Of the associated Legendre functions' recursions those that are stable for rising l, with
    // norms (2 - delta_m0) (2 l + 1) / 4pi (l - m)! / (l + m)!.
    double sectoral = std::sqrt(0.25 / std::numbers::pi);  // l = m, normed as for m = 0
    for (int m = 0; m <= degree; ++m) {
        if (m > 0) sectoral *= sine * std::sqrt((2.0 * m + 1) / (2.0 * m));
        const double first = m > 0 ? std::numbers::sqrt2 * sectoral : sectoral;
        values[moment_index(m, m)] = first;
        double before = 0;
        double last = first;
        for (int l = m + 1; l <= degree; ++l) {
            const double a = std::sqrt((4.0 * l * l - 1) / (1.0 * l * l - 1.0 * m * m));
            const double b = std::sqrt(((l - 1.0) * (l - 1.0) - 1.0 * m * m) /
                                       (4.0 * (l - 1.0) * (l - 1.0) - 1));
            const double next = a * (mu * last - b * before);
            values[moment_index(l, m)] = next;
            before = last;
            last = next;
        }
    }
}

}  // namespace

void zenith_harmonics(int degree, double mu, double* values) {
    harmonics(degree, mu, std::sqrt(std::fmax(0.0, (1 - mu) * (1 + mu))), values);
}

void harmonics_over_sines(int degree, double mu, double* values) {
    harmonics(degree, mu, 1, values);
}

double harmonic_norm(int l, int m) {
    double squared = (m == 0 ? 1.0 : 2.0) * (2.0 * l + 1) / (4 * std::numbers::pi);
    for (int k = l - m + 1; k <= l + m; ++k) squared /= k;
    return std::sqrt(squared);
}

}  // namespace skybake
