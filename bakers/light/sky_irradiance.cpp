#include "bakers/light/sky_irradiance.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <numeric>

#include "bakers/air/forward_peak.h"
#include "bakers/light/sky_row.h"
#include "bakers/light/sky_view_mapping.h"
#include "bakers/math/quadrature.h"
#include "bakers/math/transcendental.h"
#include "config/text/mapped.h"

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

// The irradiance of surfaces at one altitude by light of `light.orders()`, without SkyLight::once.
class Surface {
  public:
    // `light` must outlive this object.
    Surface(const SkyLight& light, double altitude_km)
        : light_(light),
          altitude_km_(altitude_km),
          once_(without_forward_functions(light.medium())),
          peaks_(light.orders() == config::SkyOrders::single ? take_peaks_out(once_)
                                                             : std::vector<Spectrum>{}),
          once_integrator_(once_, nullptr),
          before_integrator_(light.medium(), light.higher_orders()) {}

    // Adds the light that is scattered once.
    void add_single(const std::vector<double>& sun_cosines, int nodes,
                    std::vector<Spectrum>& sums) const;
    // Adds light that was scattered before.
    void add_multiple(const std::vector<double>& sun_cosines, const IrradianceNodes& nodes,
                      std::vector<Spectrum>& sums) const;

  private:
    // Zenith angles and azimuths over which light is summed.
    struct Directions {
        std::vector<WeightedAngle> zeniths, azimuths;
        bool before = false;  // for light that was scattered before
    };
    SkyRow row_at(double mu, double sine, bool before) const;
    template <class Light>
    void add_integral(const std::vector<std::size_t>& at, const std::vector<double>& sun_cosines,
                      const Directions& directions, const Light& light,
                      std::vector<Spectrum>& sums) const;

    const SkyLight& light_;
    double altitude_km_;
    SkyMedium once_;               // the medium without the peaks that no nodes would find
    std::vector<Spectrum> peaks_;  // of light scattered once alone: each layer's share of them
    SkyIntegrator once_integrator_;
    SkyIntegrator before_integrator_;
};

// Returns the row of a zenith angle, for light that was scattered `before` or is scattered once.
SkyRow Surface::row_at(double mu, double sine, bool before) const {
    // Any sun and any azimuth: rows use what all rays share.
    const SunZenith above = {1, 0};
    const SkyRay any =
        sky_ray(light_.shell(), altitude_km_, above, sky_direction(above, mu, sine, 1));
    return before
               ? SkyRow(before_integrator_, light_.medium(), light_.higher_orders(), any, nullptr)
               : SkyRow(once_integrator_, once_, nullptr, any, &light_.sunlight());
}

// Adds the integral over zenith angles and azimuths, on both sides of the sun, for the suns `at`.
// `light` returns the light of rays of a row.
template <class Light>
void Surface::add_integral(const std::vector<std::size_t>& at,
                           const std::vector<double>& sun_cosines, const Directions& directions,
                           const Light& light, std::vector<Spectrum>& sums) const {
    if (at.empty()) return;
    const std::vector<WeightedAngle>& azimuths = directions.azimuths;
    const auto azimuth_cosines = mapped<double>(azimuths, [&](const WeightedAngle& azimuth) {
        return std::clamp(cosine_of(azimuth.angle), -1.0, 1.0);
    });
    std::vector<SkyRay> rays;
    for (const WeightedAngle& zenith : directions.zeniths) {
        const double mu = std::clamp(cosine_of(zenith.angle), 0.0, 1.0);
        const double sine = std::clamp(sine_of(zenith.angle), 0.0, 1.0);
        const SkyRow row = row_at(mu, sine, directions.before);
        rays.clear();
        for (const std::size_t i : at) {
            const SunZenith sun = sun_of_cosine(sun_cosines[i]);
            for (const double cosine : azimuth_cosines) {
                rays.push_back(sky_ray(light_.shell(), altitude_km_, sun,
                                       sky_direction(sun, mu, sine, cosine)));
            }
        }
        const std::vector<Spectrum> values = light(row, rays);
        for (std::size_t k = 0; k < values.size(); ++k) {
            const double weight =
                2 * zenith.weight * azimuths[k % azimuths.size()].weight * sine * mu;
            sums[at[k / azimuths.size()]] += weight * values[k];
        }
    }
}

void Surface::add_single(const std::vector<double>& sun_cosines, int nodes,
                         std::vector<Spectrum>& sums) const {
    Directions directions;
    add_gathered(0, std::numbers::pi, nodes, directions.azimuths);
    const auto add = [&](const std::vector<std::size_t>& suns, double from, double to) {
        directions.zeniths.clear();
        add_gathered(from, to, nodes, directions.zeniths);
        add_integral(
            suns, sun_cosines, directions,
            [](const SkyRow& row, const std::vector<SkyRay>& rays) {
                return mapped<Spectrum>(row.radiance(rays), &SkyRadiance::single);
            },
            sums);
    };
    std::vector<std::size_t> down;
    for (std::size_t i = 0; i < sun_cosines.size(); ++i) {
        if (sun_cosines[i] <= 0) {
            down.push_back(i);
            continue;
        }
        const double at_sun = arc_cosine(sun_cosines[i]);
        add({i}, at_sun, 0);
        add({i}, at_sun, std::numbers::pi / 2);
    }
    add(down, std::numbers::pi / 2, 0);
    for (std::size_t i = 0; i < sun_cosines.size(); ++i) {
        const SunZenith sun = sun_of_cosine(sun_cosines[i]);
        if (light_.has_peaks()) add_aureole(light_, altitude_km_, sun, sums[i]);
        add_peaks(light_, peaks_, altitude_km_, sun, sums[i]);
    }
}

void Surface::add_multiple(const std::vector<double>& sun_cosines, const IrradianceNodes& nodes,
                           std::vector<Spectrum>& sums) const {
    // The mean over evenly spaced azimuths is exact below twice their number.
    const int degree = light_.higher_orders()->azimuth_degree();
    const int count =
        degree > kSmoothDegree ? std::max(nodes.azimuths, degree / 2 + 1) : nodes.azimuths;
    std::vector<std::size_t> all(sun_cosines.size());
    std::iota(all.begin(), all.end(), 0);
    Directions directions = {{}, even_azimuths(count), true};
    add_gathered(std::numbers::pi / 2, 0, nodes.zenith_angles, directions.zeniths);
    add_integral(
        all, sun_cosines, directions,
        [](const SkyRow& row, const std::vector<SkyRay>& rays) { return row.multiple(rays); },
        sums);
}

}  // namespace

std::vector<Spectrum> sky_irradiances(const SkyLight& light, double altitude_km,
                                      const std::vector<double>& sun_cosines,
                                      const IrradianceNodes& nodes) {
    const Surface surface(light, altitude_km);
    std::vector<Spectrum> sums(sun_cosines.size());
    if (light.orders() != config::SkyOrders::multiple || light.once() != nullptr) {
        surface.add_single(sun_cosines, nodes.single, sums);
    }
    if (light.once() != nullptr) {
        const std::vector<Spectrum> once =
            sky_irradiances(*light.once(), altitude_km, sun_cosines, nodes);
        for (std::size_t i = 0; i < sums.size(); ++i) sums[i] -= once[i];
    }
    if (light.higher_orders() == nullptr || light.orders() == config::SkyOrders::single) {
        return sums;
    }
    std::vector<Spectrum> multiple(sums.size());
    surface.add_multiple(sun_cosines, nodes, multiple);
    for (std::size_t i = 0; i < sums.size(); ++i) sums[i] = not_negative(sums[i] + multiple[i]);
    return sums;
}

Spectrum sun_irradiance(const SkyLight& light, double altitude_km, double sun_cos_zenith) {
    if (sun_cos_zenith <= 0) return {};
    const double r = light.shell().ground_radius_km + altitude_km;
    return sun_cos_zenith * light.sun_transmittance(altitude_km, r * sun_cos_zenith);
}

}  // namespace skybake
