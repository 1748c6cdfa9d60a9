#include "bakers/light/sky_irradiance.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <numbers>

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

SkyMedium without_forward_functions(SkyMedium medium) {
    for (SkyLayer& layer : medium.layers) {
        if (!(largest(layer.forward_share) > 0)) layer.first_phase = {};
    }
    return medium;
}

// Takes the peaks of spheres out of the phase functions of light that is scattered once alone, and
// returns their shares, by layer.
std::vector<Spectrum> take_peaks_out(SkyMedium& medium) {
    std::vector<Spectrum> shares;
    for (SkyLayer& layer : medium.layers) {
        const WidePhase wide = layer.scatters ? without_peak(layer.phase) : WidePhase{};
        shares.push_back(1.0 - wide.share);
        if (!wide.has_peak) continue;
        layer.first_phase = wide.phase;
        layer.first_factor = wide.share;
    }
    return shares;
}

// Adds the light that peaks scatter once. It comes from next to the sun; each point of the way adds as much.
void add_peaks(const SkyLight& light, const std::vector<Spectrum>& shares, double altitude_km,
               const SunZenith& sun, Spectrum& sum) {
    if (sun.cosine <= 0) return;
    const double s_km = (light.shell().ground_radius_km + altitude_km) * sun.cosine;
    const Spectrum sunlight = sun.cosine * light.integrator().sunlight(altitude_km, s_km);
    for (std::size_t k = 0; k < shares.size(); ++k) {
        if (!(largest(shares[k]) > 0)) continue;
        sum += shares[k] * sunlight * scattering_depth(light.medium().layers[k], altitude_km, s_km);
    }
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

// Azimuths over half a turn: Gauss' rule for polynomials in their cosine, evenly spaced ones.
std::vector<WeightedAngle> even_azimuths(int count) {
    std::vector<WeightedAngle> azimuths;
    for (int i = 0; i < count; ++i) {
        azimuths.push_back({std::numbers::pi * (i + 0.5) / count, std::numbers::pi / count});
    }
    return azimuths;
}

// Adds the integral over zenith angles and azimuths, on both sides of the sun. `light` returns the
// light of a row, given its rays and the cosines of its azimuths.
template <class TracedZeniths, class Light>
void add_integral(const Shell& shell, double altitude_km, const SunZenith& sun,
                  const TracedZeniths& zeniths, const std::vector<WeightedAngle>& azimuths,
                  const Light& light, Spectrum& sum) {
    std::vector<double> azimuth_cosines;
    for (const WeightedAngle& azimuth : azimuths) {
        azimuth_cosines.push_back(std::clamp(cosine_of(azimuth.angle), -1.0, 1.0));
    }
    for (const auto& zenith : zeniths) {
        const auto ray_at = [&](double azimuth_cosine) {
            return sky_ray(shell, altitude_km, sun,
                           sky_direction(sun, zenith.mu, zenith.sine, azimuth_cosine));
        };
        const std::vector<Spectrum> values = light(zenith.row, ray_at, azimuth_cosines);
        for (std::size_t i = 0; i < azimuths.size(); ++i) {
            const double weight = 2 * zenith.weight * azimuths[i].weight * zenith.sine * zenith.mu;
            sum += weight * values[i];
        }
    }
}

}  // namespace

// The rays of one zenith angle.
struct SkyIrradiance::TracedZenith {
    double mu;
    double sine;
    double weight;  // of an integral over the zenith angle
    SkyRow row;
};

SkyIrradiance::SkyIrradiance(const SkyLight& light, double altitude_km)
    : light_(light),
      altitude_km_(altitude_km),
      once_(without_forward_functions(light.medium())),
      peaks_(light.orders() == config::SkyOrders::single ? take_peaks_out(once_)
                                                         : std::vector<Spectrum>{}),
      once_integrator_(once_, nullptr),
      before_integrator_(light.medium(), light.higher_orders()),
      apart_(light.once() != nullptr ? std::make_unique<SkyIrradiance>(*light.once(), altitude_km)
                                     : nullptr) {}

SkyIrradiance::~SkyIrradiance() = default;

// Traces light that was scattered `before`, or else light that is scattered once.
SkyIrradiance::TracedZeniths SkyIrradiance::trace(double from, double to, int nodes,
                                                  bool before) const {
    std::vector<WeightedAngle> angles;
    add_gathered(from, to, nodes, angles);
    TracedZeniths zeniths;
    for (const WeightedAngle& angle : angles) {
        const double mu = std::clamp(cosine_of(angle.angle), 0.0, 1.0);
        const double sine = std::clamp(sine_of(angle.angle), 0.0, 1.0);
        // Any sun and any azimuth: rows use what all rays share.
        const SunZenith above = {1, 0};
        const SkyRay any =
            sky_ray(light_.shell(), altitude_km_, above, sky_direction(above, mu, sine, 1));
        zeniths.push_back(
            {mu, sine, angle.weight,
             before
                 ? SkyRow(before_integrator_, light_.medium(), light_.higher_orders(), any, nullptr)
                 : SkyRow(once_integrator_, once_, nullptr, any, &light_.sunlight())});
    }
    return zeniths;
}

// Traces those from the horizon up when first asked for them, and when their number changes.
const SkyIrradiance::TracedZeniths& SkyIrradiance::kept(TracedZeniths& zeniths, int nodes,
                                                        bool before) const {
    if (zeniths.size() != static_cast<std::size_t>(nodes)) {
        zeniths = trace(std::numbers::pi / 2, 0, nodes, before);
    }
    return zeniths;
}

Spectrum SkyIrradiance::single(const SunZenith& sun, int nodes) {
    std::vector<WeightedAngle> azimuths;
    add_gathered(0, std::numbers::pi, nodes, azimuths);
    const auto light = [](const SkyRow& row, const auto& ray_at, const auto& cosines) {
        std::vector<Spectrum> values;
        for (const SkyRadiance& radiance : row.radiance(ray_at, cosines)) {
            values.push_back(radiance.single);
        }
        return values;
    };
    Spectrum sum{};
    const auto add = [&](const TracedZeniths& zeniths) {
        add_integral(light_.shell(), altitude_km_, sun, zeniths, azimuths, light, sum);
    };
    if (sun.cosine <= 0) {
        add(kept(dark_, nodes, false));
        return sum;
    }
    const double at_sun = arc_cosine(sun.cosine);
    add(trace(at_sun, 0, nodes, false));
    add(trace(at_sun, std::numbers::pi / 2, nodes, false));
    return sum;
}

Spectrum SkyIrradiance::multiple(const SunZenith& sun, const IrradianceNodes& nodes) {
    // The mean over evenly spaced azimuths is exact below twice their number.
    const int degree = light_.higher_orders()->azimuth_degree();
    const int count =
        degree > kSmoothDegree ? std::max(nodes.azimuths, degree / 2 + 1) : nodes.azimuths;
    Spectrum sum{};
    add_integral(
        light_.shell(), altitude_km_, sun, kept(before_, nodes.zenith_angles, true),
        even_azimuths(count),
        [](const SkyRow& row, const auto& ray_at, const auto& cosines) {
            return row.multiple(ray_at, cosines);
        },
        sum);
    return sum;
}

Spectrum SkyIrradiance::under(double sun_cos_zenith, const IrradianceNodes& nodes) {
    assert(sun_cos_zenith >= -1 && sun_cos_zenith <= 1);
    const SunZenith sun = sun_of_cosine(sun_cos_zenith);
    Spectrum sum{};
    if (light_.orders() != config::SkyOrders::multiple || apart_) {
        sum = single(sun, nodes.single);
        if (light_.has_peaks()) add_aureole(light_, altitude_km_, sun, sum);
        add_peaks(light_, peaks_, altitude_km_, sun, sum);
    }
    if (apart_) sum -= apart_->under(sun_cos_zenith, nodes);
    if (light_.higher_orders() != nullptr && light_.orders() != config::SkyOrders::single) {
        sum = not_negative(sum + multiple(sun, nodes));
    }
    return sum;
}

Spectrum sky_irradiance(const SkyLight& light, double altitude_km, double sun_cos_zenith,
                        const IrradianceNodes& nodes) {
    return SkyIrradiance(light, altitude_km).under(sun_cos_zenith, nodes);
}

Spectrum sun_irradiance(const SkyLight& light, double altitude_km, double sun_cos_zenith) {
    if (sun_cos_zenith <= 0) return {};
    const double r = light.shell().ground_radius_km + altitude_km;
    return sun_cos_zenith * light.sun_transmittance(altitude_km, r * sun_cos_zenith);
}

}  // namespace skybake
