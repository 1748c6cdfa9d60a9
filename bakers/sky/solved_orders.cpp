#include "bakers/sky/solved_orders.h"

#include <algorithm>
#include <cstddef>

#include "bakers/phase/legendre_moments.h"

namespace skybake {

SolvedOrders::SolvedOrders(const SkyMedium& medium, const SolvedLight& light, int degree)
    : light_(light), degree_(std::min(degree, light.degree())) {
    for (const SkyLayer& layer : medium.layers) {
        phase_moments_.push_back(legendre_moments(layer.phase, degree_));
    }
}

Spectrum SolvedOrders::scattered(const ScatteringPoint& point,
                                 const std::vector<Spectrum>& scattering_per_km) const {
    std::vector<double> moments(static_cast<std::size_t>(moment_count(light_.degree())) *
                                kMaxChannels);
    light_.moments_at(point.altitude_km, point.sun_cos_zenith, moments.data());
    std::vector<double> harmonics(static_cast<std::size_t>(moment_count(degree_)));
    zenith_harmonics(degree_, point.view_cos_zenith, harmonics.data());
    Spectrum sum{};
    for (int l = 0; l <= degree_; ++l) {
        Spectrum of_degree{};
        double last = 1;  // cos(m phi), by Chebyshev's recursion
        double before = point.azimuth_cosine;
        for (int m = 0; m <= l; ++m) {
            const auto lm = static_cast<std::size_t>(moment_index(l, m));
            for (std::size_t c = 0; c < sum.size(); ++c) {
                of_degree[c] += harmonics[lm] * last * moments[lm * kMaxChannels + c];
            }
            const double next = 2 * point.azimuth_cosine * last - before;
            before = last;
            last = next;
        }
        for (std::size_t k = 0; k < scattering_per_km.size(); ++k) {
            const double chi = phase_moments_[k][static_cast<std::size_t>(l)];
            for (std::size_t c = 0; c < sum.size(); ++c) {
                sum[c] += scattering_per_km[k][c] * chi * of_degree[c];
            }
        }
    }
    return sum;
}

Spectrum SolvedOrders::sky_irradiance(double sun_cos_zenith) const {
    return light_.sky_irradiance_at(sun_cos_zenith);
}

}  // namespace skybake
