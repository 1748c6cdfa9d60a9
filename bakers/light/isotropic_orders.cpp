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
        sum += layer * psi;
    }
    return sum;
}

Spectrum IsotropicOrders::sky_irradiance(double sun_cos_zenith) const {
    constexpr double kPi = std::numbers::pi;
    const Spectrum psi = mean_radiance_(0, sun_cos_zenith);
    const Spectrum& albedo = medium_.ground_albedo;
    Spectrum sun{};
    if (sun_cos_zenith > 0) {
        const double s_km = medium_.ground_radius_km * sun_cos_zenith;
        sun = sun_cos_zenith * exponential(-optical_depth_to_top(medium_, 0, s_km)) / kPi;
    }
    // Not negative but for what the table's interpolation leaves.
    return kPi * maximum(2.0 * psi - albedo * sun, Spectrum(0.0)) / (1.0 + albedo);
}

}  // namespace skybake
