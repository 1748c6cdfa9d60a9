// What a km of air scatters towards an eye, from moments of the light (light_moments.h).
#pragma once

#include <cstddef>
#include <vector>

#include "bakers/light/higher_orders.h"
#include "bakers/light/solver/light_moments.h"

namespace skybake {

// A moment L_lm, and the factor of cos(m phi) that it stands with for the view at hand.
struct WeightedMoment {
    double weight = 0;
    Spectrum value{};
};

// Sum over layers of sigma_s sum over l of chi_l sum over m of weight L_lm cos(m phi), l up to the
// degree. `phase_moments` are chi of each layer, `moment(l, m)` gives a WeightedMoment.
template <class Moment>
Spectrum moment_sum(int degree, double azimuth_cosine,
                    const std::vector<Spectrum>& scattering_per_km,
                    const std::vector<std::vector<Spectrum>>& phase_moments, const Moment& moment) {
    Spectrum sum{};
    for (int l = 0; l <= degree; ++l) {
        Spectrum of_degree{};
        double last = 1;  // cos(m phi), by Chebyshev's recursion
        double before = azimuth_cosine;
        for (int m = 0; m <= l; ++m) {
            const WeightedMoment of = moment(l, m);
            of_degree += of.weight * last * of.value;
            const double next = 2 * azimuth_cosine * last - before;
            before = last;
            last = next;
        }
        for (std::size_t k = 0; k < scattering_per_km.size(); ++k) {
            const Spectrum& chi = phase_moments[k][static_cast<std::size_t>(l)];
            sum += scattering_per_km[k] * chi * of_degree;
        }
    }
    return sum;
}

}  // namespace skybake
