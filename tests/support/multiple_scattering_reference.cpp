#include "tests/support/multiple_scattering_reference.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include "bakers/air/optical_depth.h"
#include "bakers/air/ray.h"
#include "bakers/math/quadrature.h"
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
                return range * x * g(horizon + sign * range * x * x, below);
            };
            return adaptive_integral<Spectrum>(integrand, 0.0, 1.0, relative_, 1e-14, 12);
        };
        return side(1 - horizon, 1, false) + side(1 + horizon, -1, true);
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
            return source(x, altitude) *
                   exponential(-optical_depth_along(medium_, altitude_km_, mu, x));
        };
        Spectrum sum{};
        for (std::size_t i = 0; i + 1 < breaks.size(); ++i) {
            sum += adaptive_integral<Spectrum>(integrand, breaks[i], breaks[i + 1], relative_,
                                               1e-16, 12);
        }
        return sum;
    }

    Spectrum end_transmittance(double mu, bool below) const {
        const double length = length_km(r_km_ * mu, below);
        return exponential(-optical_depth_along(medium_, altitude_km_, mu, length));
    }

    // Light that arrives from (mu, azimuth) after one bounce off air or ground.
    Spectrum second_order_radiance(double mu, double azimuth, bool below) const {
        const double sine = std::sqrt(std::max(0.0, (1 - mu) * (1 + mu)));
        const double view_dot_sun = mu * sun_cos_ + sine * sun_sin_ * std::cos(azimuth);
        const auto source = [&](double x, double altitude) {
            const Spectrum sunlight = sunlight_at(altitude, r_km_ * sun_cos_ + x * view_dot_sun);
            return scattering_at(medium_, altitude) * (sunlight / (4 * kPi));
        };
        const double length = length_km(r_km_ * mu, below);
        Spectrum sum = along_ray(mu, below, shadow_edges_km(mu, view_dot_sun, length), source);
        if (below) {
            const double s = r_km_ * sun_cos_ + length * view_dot_sun;
            if (s > 0) {
                const Spectrum sunlight = sunlight_at(0, s);
                const Spectrum transmittance = end_transmittance(mu, below);
                const double cosine = s / shell_.ground_radius_km;
                sum += transmittance * medium_.ground_albedo / kPi * cosine * sunlight;
            }
        }
        return sum;
    }

    // The mean over azimuths, which adaptive halving splits where the shadow's edge enters.
    Spectrum mean_over_azimuth(double mu, bool below) const {
        const auto radiance = [&](double azimuth) {
            return second_order_radiance(mu, azimuth, below);
        };
        return adaptive_integral<Spectrum>(radiance, 0.0, kPi, relative_, 1e-12, 10) / kPi;
    }

    Spectrum scattering(double altitude) const { return scattering_at(medium_, altitude); }
    Spectrum absorption(double altitude) const {
        return extinction_at(medium_, altitude) - scattering_at(medium_, altitude);
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
        return exponential(-optical_depth_to_top(medium_, altitude, s));
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
        return point.end_transmittance(mu, below) +
               point.along_ray(mu, below, {},
                               [&](double, double h) { return point.absorption(h); });
    });
    terms.second_order = point.mean_over_zenith(
        [&](double mu, bool below) { return point.mean_over_azimuth(mu, below); });
    terms.psi = terms.second_order / terms.escape;
    return terms;
}

}  // namespace skybake
