#include "bakers/light/solved_orders.h"

#include <algorithm>
#include <cstddef>

#include "bakers/light/moment_sum.h"

namespace skybake {

SolvedOrders::SolvedOrders(const SkyMedium& medium, const SolvedLight& light, int degree)
    : light_(light), degree_(std::min(degree, light.degree())) {
    for (const SkyLayer& layer : medium.layers) {
        phase_moments_.push_back(legendre_moments(layer.phase, degree_));
    }
}

Spectrum SolvedOrders::scattered(const ScatteringPoint& point,
                                 const std::vector<Spectrum>& scattering_per_km) const {
    std::vector<Spectrum> moments(static_cast<std::size_t>(moment_count(light_.degree())));
    light_.moments_at(point.altitude_km, point.sun_cos_zenith, moments.data());
    std::vector<double> harmonics(static_cast<std::size_t>(moment_count(degree_)));
    zenith_harmonics(degree_, point.view_cos_zenith, harmonics.data());
    return moment_sum(degree_, point.azimuth_cosine, scattering_per_km, phase_moments_,
                      [&](int l, int m) {
                          const auto lm = static_cast<std::size_t>(moment_index(l, m));
                          return WeightedMoment{harmonics[lm], moments[lm]};
                      });
}

Spectrum SolvedOrders::sky_irradiance(double sun_cos_zenith) const {
    return light_.sky_irradiance_at(sun_cos_zenith);
}

}  // namespace skybake
