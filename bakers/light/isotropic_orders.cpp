#include "bakers/light/isotropic_orders.h"

#include <algorithm>
#include <cstddef>
#include <numbers>
#include <utility>

#include "bakers/air/optical_depth.h"
#include "bakers/math/transcendental.h"

namespace skybake {

IsotropicOrders::IsotropicOrders(const Medium& medium, MeanRadiance mean_radiance)
    : medium_(medium), mean_radiance_(std::move(mean_radiance)) {}

Spectrum IsotropicOrders::scattered(const ScatteringPoint& point,
                                    const std::vector<Spectrum>& scattering_per_km) const {
    const Spectrum psi = mean_radiance_(point.altitude_km, point.sun_cos_zenith);
    Spectrum sum{};
    for (const Spectrum& layer : scattering_per_km) {
        for (std::size_t c = 0; c < sum.size(); ++c) sum[c] += layer[c] * psi[c];
    }
    return sum;
}

Spectrum IsotropicOrders::sky_irradiance(double sun_cos_zenith) const {
    constexpr double kPi = std::numbers::pi;
    const Spectrum psi = mean_radiance_(0, sun_cos_zenith);
    Spectrum depth{};
    const bool day = sun_cos_zenith > 0;
    if (day) depth = optical_depth_to_top(medium_, 0, medium_.ground_radius_km * sun_cos_zenith);
    Spectrum irradiance{};
    for (std::size_t c = 0; c < static_cast<std::size_t>(medium_.channels); ++c) {
        const double albedo = medium_.ground_albedo[c];
        const double sun = day ? sun_cos_zenith * exponential(-depth[c]) / kPi : 0;
        // Not negative but for what the table's interpolation leaves.
        irradiance[c] = kPi * std::max(2 * psi[c] - albedo * sun, 0.0) / (1 + albedo);
    }
    return irradiance;
}

}  // namespace skybake
