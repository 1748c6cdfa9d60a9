#include "bakers/light/sky_irradiance.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include "bakers/air/forward_peak.h"
#include "bakers/light/sky_row.h"
#include "bakers/light/sky_view_mapping.h"
#include "bakers/math/quadrature.h"
#include "bakers/math/transcendental.h"

namespace skybake {

namespace {

// Higher orders of at most this degree in the azimuth's cosine have few azimuths, whose number is
// chosen by its error (IrradianceNodes).
constexpr int kSmoothDegree = 8;

struct WeightedAngle {
    double angle;
    double weight;  // of an integral over the angle
};

// Nodes from `from` to `to`, densest at `from`: angle = from + (to - from) t^2.
void add_gathered(double from, double to, int nodes, std::vector<WeightedAngle>& angles) {
    if (from == to) return;
    const QuadratureRule rule = gauss_legendre(nodes);
    for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
        const double t = rule.nodes[i];
        angles.push_back(
            {from + (to - from) * t * t, std::fabs(to - from) * 2 * t * rule.weights[i]});
    }
}

SunZenith sun_of_cosine(double cosine) { return {cosine, std::sqrt((1 - cosine) * (1 + cosine))}; }

// Integrates over zenith angles and azimuths, on both sides of the sun.
Spectrum integrate(const SkyLight& light, const SkyMedium& medium,
                   const HigherOrders* higher_orders, double altitude_km, const SunZenith& sun,
                   const std::vector<WeightedAngle>& zenith_angles,
                   const std::vector<WeightedAngle>& azimuths, Spectrum SkyRadiance::*part) {
    std::vector<double> azimuth_cosines;
    for (const WeightedAngle& azimuth : azimuths) {
        azimuth_cosines.push_back(std::clamp(cosine_of(azimuth.angle), -1.0, 1.0));
    }
    const SkyIntegrator integrator(medium, higher_orders);
    Spectrum sum{};
    for (const WeightedAngle& zenith : zenith_angles) {
        const double mu = std::clamp(cosine_of(zenith.angle), 0.0, 1.0);
        const double sine = std::clamp(sine_of(zenith.angle), 0.0, 1.0);
        const auto ray_at = [&](double azimuth_cosine) {
            return sky_ray(light.shell(), altitude_km, sun,
                           sky_direction(sun, mu, sine, azimuth_cosine));
        };
        const SkyRow row(integrator, medium, higher_orders, ray_at(1));
        const std::vector<SkyRadiance> radiance = row.radiance(ray_at, azimuth_cosines);
        for (std::size_t i = 0; i < azimuths.size(); ++i) {
            const double weight = 2 * zenith.weight * azimuths[i].weight * sine * mu;
            sum += weight * (radiance[i].*part);
        }
    }
    return sum;
}

Spectrum single_irradiance(const SkyLight& light, double altitude_km, const SunZenith& sun,
                           int nodes) {
    std::vector<WeightedAngle> zenith_angles;
    const double from = std::min(arc_cosine(sun.cosine), std::numbers::pi / 2);
    add_gathered(from, 0, nodes, zenith_angles);
    add_gathered(from, std::numbers::pi / 2, nodes, zenith_angles);
    std::vector<WeightedAngle> azimuths;
    add_gathered(0, std::numbers::pi, nodes, azimuths);
    SkyMedium medium = light.medium();
    for (SkyLayer& layer : medium.layers) {
        if (!(largest(layer.forward_share) > 0)) layer.first_phase = {};
    }
    return integrate(light, medium, nullptr, altitude_km, sun, zenith_angles, azimuths,
                     &SkyRadiance::single);
}

// Replaces the light that peaks scatter forward from next to the sun by sunlight that would not
// arrive without them. No nodes would find the peaks of spheres, so they are not in the sum; those
// of delta_scaled are, and are taken out: of what such a layer scatters in the medium without peaks,
// f / (1 - f) went into its peak.
void add_aureole(const SkyLight& light, double altitude_km, const SunZenith& sun, Spectrum& sum) {
    if (sun.cosine <= 0) return;
    const double s_km = (light.shell().ground_radius_km + altitude_km) * sun.cosine;
    const Spectrum with_peaks = light.integrator().sunlight(altitude_km, s_km);
    const Spectrum without = light.sun_transmittance(altitude_km, s_km);
    sum += sun.cosine * (with_peaks - without);
    for (const SkyLayer& layer : light.medium().layers) {
        if (!layer.scatters || !(largest(layer.forward_share) > 0)) continue;
        sum -= sun.cosine * with_peaks * scattering_depth(layer, altitude_km, s_km) *
               layer.forward_share / (1.0 - layer.forward_share);
    }
}

// Gauss' rule for the integral over azimuths of a polynomial in their cosine: evenly spaced ones.
Spectrum multiple_irradiance(const SkyLight& light, double altitude_km, const SunZenith& sun,
                             const IrradianceNodes& nodes) {
    std::vector<WeightedAngle> zenith_angles;
    add_gathered(std::numbers::pi / 2, 0, nodes.zenith_angles, zenith_angles);
    std::vector<WeightedAngle> azimuths;
    // The mean over evenly spaced azimuths is exact below twice their number.
    const int degree = light.higher_orders()->azimuth_degree();
    const int count =
        degree > kSmoothDegree ? std::max(nodes.azimuths, degree / 2 + 1) : nodes.azimuths;
    for (int i = 0; i < count; ++i) {
        azimuths.push_back({std::numbers::pi * (i + 0.5) / count, std::numbers::pi / count});
    }
    return integrate(light, light.medium(), light.higher_orders(), altitude_km, sun, zenith_angles,
                     azimuths, &SkyRadiance::multiple);
}

}  // namespace

Spectrum sky_irradiance(const SkyLight& light, double altitude_km, double sun_cos_zenith,
                        const IrradianceNodes& nodes) {
    assert(sun_cos_zenith >= -1 && sun_cos_zenith <= 1);
    const SunZenith sun = sun_of_cosine(sun_cos_zenith);
    Spectrum sum{};
    if (light.orders() != config::SkyOrders::multiple) {
        sum = single_irradiance(light, altitude_km, sun, nodes.single);
        if (light.has_peaks()) add_aureole(light, altitude_km, sun, sum);
    }
    if (light.higher_orders() != nullptr && light.orders() != config::SkyOrders::single) {
        sum += not_negative(multiple_irradiance(light, altitude_km, sun, nodes));
    }
    return sum;
}

Spectrum sun_irradiance(const SkyLight& light, double altitude_km, double sun_cos_zenith) {
    if (sun_cos_zenith <= 0) return {};
    const double r = light.shell().ground_radius_km + altitude_km;
    return sun_cos_zenith * light.sun_transmittance(altitude_km, r * sun_cos_zenith);
}

}  // namespace skybake
