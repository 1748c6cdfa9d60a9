#include "tests/support/multiple_scattering_reference.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include "bakers/air/optical_depth.h"
#include "bakers/air/ray.h"
#include "bakers/air/ray_breaks.h"
#include "bakers/math/adaptive_quadrature.h"
#include "bakers/math/transcendental.h"

namespace skybake {

namespace {

constexpr double kPi = std::numbers::pi;

// The integrals at one point. Directions are (mu, azimuth from the sun).
class Point {
  public:
    Point(const Medium& medium, double altitude_km, double sun_cos_zenith, double relative)
        : medium_(medium),
          shell_(shell_of(medium)),
          altitude_km_(altitude_km),
          r_km_(shell_.ground_radius_km + altitude_km),
          sun_cos_(sun_cos_zenith),
          sun_sin_(std::sqrt(std::max(0.0, (1 - sun_cos_zenith) * (1 + sun_cos_zenith)))),
          relative_(relative),
          break_altitudes_km_(break_altitudes_km(medium, {1, 3, 8, 20})) {}

    // The mean over all directions of g(mu, whether the ray hits the ground).
    template <class Function>
    Spectrum mean_over_zenith(const Function& g) const {
        const double horizon = -horizon_distance_km(shell_, altitude_km_) / r_km_;
        const auto side = [&](double range, double sign, bool below) {
            // mu = horizon +- range x^2 takes away the horizon's square root.
            const auto integrand = [&](double x) {
                Spectrum value = g(horizon + sign * range * x * x, below);
                for (double& v : value) v *= range * x;
                return value;
            };
            return adaptive_integral<Spectrum>(integrand, 0.0, 1.0, relative_, 1e-14, 12);
        };
        Spectrum sum = side(1 - horizon, 1, false);
        const Spectrum below = side(1 + horizon, -1, true);
        for (std::size_t c = 0; c < sum.size(); ++c) sum[c] += below[c];
        return sum;
    }

    // Integral along the ray of coefficient(h) T(start, x), per channel.
    template <class Function>
    Spectrum along_ray(double mu, bool below, const std::vector<double>& further_breaks,
                       const Function& source) const {
        const double s = r_km_ * mu;
        const double length = length_km(s, below);
        if (!(length > 0)) return {};
        std::vector<double> breaks = further_breaks;
        for (const RayBreak& at :
             ray_breaks(shell_, altitude_km_, s, length, break_altitudes_km_)) {
            breaks.push_back(at.distance_km);
        }
        std::sort(breaks.begin(), breaks.end());
        const auto integrand = [&](double x) {
            const double altitude = altitude_at(s, x);
            Spectrum value = source(x, altitude);
            const Spectrum depth = optical_depth_along(medium_, altitude_km_, mu, x);
            for (std::size_t c = 0; c < value.size(); ++c) value[c] *= exponential(-depth[c]);
            return value;
        };
        Spectrum sum{};
        for (std::size_t i = 0; i + 1 < breaks.size(); ++i) {
            const Spectrum part = adaptive_integral<Spectrum>(integrand, breaks[i], breaks[i + 1],
                                                              relative_, 1e-16, 12);
            for (std::size_t c = 0; c < sum.size(); ++c) sum[c] += part[c];
        }
        return sum;
    }

    Spectrum end_transmittance(double mu, bool below) const {
        const double length = length_km(r_km_ * mu, below);
        Spectrum result = optical_depth_along(medium_, altitude_km_, mu, length);
        for (double& value : result) value = exponential(-value);
        return result;
    }

    // Light that arrives from (mu, azimuth) after one bounce off air or ground.
    Spectrum second_order_radiance(double mu, double azimuth, bool below) const {
        const double sine = std::sqrt(std::max(0.0, (1 - mu) * (1 + mu)));
        const double view_dot_sun = mu * sun_cos_ + sine * sun_sin_ * std::cos(azimuth);
        const auto source = [&](double x, double altitude) {
            const Spectrum sunlight = sunlight_at(altitude, r_km_ * sun_cos_ + x * view_dot_sun);
            Spectrum value = scattering_at(medium_, altitude);
            for (std::size_t c = 0; c < value.size(); ++c) value[c] *= sunlight[c] / (4 * kPi);
            return value;
        };
        const double length = length_km(r_km_ * mu, below);
        Spectrum sum = along_ray(mu, below, shadow_edges_km(mu, view_dot_sun, length), source);
        if (below) {
            const double s = r_km_ * sun_cos_ + length * view_dot_sun;
            if (s > 0) {
                const Spectrum sunlight = sunlight_at(0, s);
                const Spectrum transmittance = end_transmittance(mu, below);
                const double cosine = s / shell_.ground_radius_km;
                for (std::size_t c = 0; c < sum.size(); ++c) {
                    sum[c] +=
                        transmittance[c] * medium_.ground_albedo[c] / kPi * cosine * sunlight[c];
                }
            }
        }
        return sum;
    }

    // The mean over azimuths, which adaptive halving splits where the shadow's edge enters.
    Spectrum mean_over_azimuth(double mu, bool below) const {
        const auto radiance = [&](double azimuth) {
            return second_order_radiance(mu, azimuth, below);
        };
        Spectrum sum = adaptive_integral<Spectrum>(radiance, 0.0, kPi, relative_, 1e-12, 10);
        for (double& value : sum) value /= kPi;
        return sum;
    }

    Spectrum scattering(double altitude) const { return scattering_at(medium_, altitude); }
    Spectrum absorption(double altitude) const {
        Spectrum value = extinction_at(medium_, altitude);
        const Spectrum scattered = scattering_at(medium_, altitude);
        for (std::size_t c = 0; c < value.size(); ++c) value[c] -= scattered[c];
        return value;
    }

  private:
    double length_km(double s, bool below) const {
        return below ? distance_to_ground_km(shell_, altitude_km_, s)
                     : distance_to_top_km(shell_, altitude_km_, s);
    }

    double altitude_at(double s, double x) const {
        return std::clamp(altitude_along_km(shell_, altitude_km_, s, x), 0.0, shell_.thickness_km);
    }

    // Transmittance towards the sun from an altitude where r mu_s = s; none in the planet's shadow.
    Spectrum sunlight_at(double altitude, double s) const {
        if (s < -horizon_distance_km(shell_, altitude)) return {};
        Spectrum result = optical_depth_to_top(medium_, altitude, s);
        for (double& value : result) value = exponential(-value);
        return result;
    }

    // Where the ray crosses the cylinder of the planet's shadow: |P|^2 - (P . sun)^2 = R^2.
    std::vector<double> shadow_edges_km(double mu, double view_dot_sun, double length) const {
        const double a = (1 - view_dot_sun) * (1 + view_dot_sun);
        const double b = r_km_ * (mu - sun_cos_ * view_dot_sun);
        const double rho = horizon_distance_km(shell_, altitude_km_);
        const double along = r_km_ * sun_cos_;
        const double c = (rho - along) * (rho + along);
        const double discriminant = b * b - a * c;
        std::vector<double> edges;
        if (!(a > 0) || discriminant < 0) return edges;
        const double q = -(b + std::copysign(std::sqrt(discriminant), b));
        for (const double x : {q / a, q != 0 ? c / q : 0.0}) {
            if (x > 0 && x < length) edges.push_back(x);
        }
        return edges;
    }

    const Medium& medium_;
    Shell shell_;
    double altitude_km_;
    double r_km_;
    double sun_cos_;
    double sun_sin_;
    double relative_;
    std::vector<double> break_altitudes_km_;
};

}  // namespace

MultipleScatteringTerms reference_multiple_scattering(const Medium& medium, double altitude_km,
                                                      double sun_cos_zenith, double relative) {
    const Point point(medium, altitude_km, sun_cos_zenith, relative);
    MultipleScatteringTerms terms;
    terms.scattered = point.mean_over_zenith([&](double mu, bool below) {
        return point.along_ray(mu, below, {},
                               [&](double, double h) { return point.scattering(h); });
    });
    terms.escape = point.mean_over_zenith([&](double mu, bool below) {
        Spectrum sum = point.end_transmittance(mu, below);
        const Spectrum absorbed =
            point.along_ray(mu, below, {}, [&](double, double h) { return point.absorption(h); });
        for (std::size_t c = 0; c < sum.size(); ++c) sum[c] += absorbed[c];
        return sum;
    });
    terms.second_order = point.mean_over_zenith(
        [&](double mu, bool below) { return point.mean_over_azimuth(mu, below); });
    for (std::size_t c = 0; c < static_cast<std::size_t>(medium.channels); ++c) {
        terms.psi[c] = terms.second_order[c] / terms.escape[c];
    }
    return terms;
}

}  // namespace skybake
