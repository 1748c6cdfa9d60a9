#include "bakers/light/solved_source.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace skybake {

namespace {

// Sum over layers of scattering and phase moment, times the view's harmonic: [lm].
std::vector<Spectrum> view_factors(int degree, double view_cos_zenith,
                                   const std::vector<Spectrum>& scattering,
                                   const std::vector<std::vector<Spectrum>>& phase_moments) {
    const auto count = static_cast<std::size_t>(moment_count(degree));
    std::vector<double> harmonics(count);
    zenith_harmonics(degree, view_cos_zenith, harmonics.data());
    std::vector<Spectrum> factors(count);
    for (int l = 0; l <= degree; ++l) {
        for (int m = 0; m <= l; ++m) {
            const auto lm = static_cast<std::size_t>(moment_index(l, m));
            for (std::size_t k = 0; k < scattering.size(); ++k) {
                const Spectrum& chi = phase_moments[k][static_cast<std::size_t>(l)];
                factors[lm] += scattering[k] * chi * harmonics[lm];
            }
        }
    }
    return factors;
}

}  // namespace

SolvedSource::SolvedSource(const SolvedLight& light, double altitude_km, double view_cos_zenith,
                           const std::vector<Spectrum>& scattering,
                           const std::vector<std::vector<Spectrum>>& phase_moments)
    : light_(light) {
    const int degree = light.degree();
    const auto orders = static_cast<std::size_t>(degree) + 1;
    const LevelPlace at = light.level_at(altitude_km);
    const std::vector<Spectrum> factors =
        view_factors(degree, view_cos_zenith, scattering, phase_moments);
    values_.resize(static_cast<std::size_t>(light.suns.count()) * orders);
    for (int sun = 0; sun < light.suns.count(); ++sun) {
        const double* below = light.light.at(at.level, sun);
        const double* over = light.light.at(at.level + 1, sun);
        Spectrum* values = values_.data() + static_cast<std::size_t>(sun) * orders;
        for (int l = 0; l <= degree; ++l) {
            for (int m = 0; m <= l; ++m) {
                const auto lm = static_cast<std::size_t>(moment_index(l, m));
                values[m] +=
                    factors[lm] * ((1 - at.fraction) * packet_at(below + lm * kChannelSlots) +
                                   at.fraction * packet_at(over + lm * kChannelSlots));
            }
        }
    }
}

Spectrum SolvedSource::scattered(double sun_cos_zenith, double azimuth_cosine) const {
    const SunStencil stencil = light_.stencil(sun_cos_zenith);
    const auto orders = static_cast<std::size_t>(light_.degree()) + 1;
    const Spectrum* values = values_.data() + static_cast<std::size_t>(stencil.column) * orders;
    const double sine = std::sqrt((1 - sun_cos_zenith) * (1 + sun_cos_zenith));
    Spectrum sum{};
    double power = 1;  // sine^m
    double last = 1;   // cos(m phi), by Chebyshev's recursion
    double before = azimuth_cosine;
    for (std::size_t m = 0; m < orders; ++m) {
        const Spectrum* at = values + m;
        sum += power * last *
               (stencil.weights[0] * at[0] + stencil.weights[1] * at[orders] +
                stencil.weights[2] * at[2 * orders] + stencil.weights[3] * at[3 * orders]);
        const double next = 2 * azimuth_cosine * last - before;
        before = last;
        last = next;
        power *= sine;
    }
    return sum;
}

}  // namespace skybake
