#include "bakers/light/solver/energy_balance.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include "bakers/air/optical_depth.h"
#include "bakers/math/quadrature.h"
#include "bakers/math/transcendental.h"

namespace skybake {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr int kSunNodes = 24;   // of each part of the suns
constexpr int kLevelNodes = 2;  // between levels

// Calls visit(sun_cos_zenith, share of the circle of suns) for nodes between two cosines.
template <class Visit>
void for_suns(double from, double to, const Visit& visit) {
    static const QuadratureRule rule = gauss_legendre(kSunNodes);
    for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
        // Densest at `from`, where the sun sets.
        const double x = rule.nodes[i];
        visit(from + (to - from) * x * x, 2 * x * rule.weights[i] * (to - from));
    }
}

// Does as for_suns does, over all suns that have light.
template <class Visit>
void for_all_suns(const SunAxis& axis, const Visit& visit) {
    for_suns(axis.centre, 1, visit);
    for_suns(axis.centre, axis.darkest,
             [&](double cosine, double weight) { visit(cosine, -weight); });
}

Spectrum sunlight(const Medium& air, double altitude_km, double sun_cos_zenith) {
    const double r = air.ground_radius_km + altitude_km;
    return exponential(-optical_depth_to_top(air, altitude_km, r * sun_cos_zenith));
}

void add_air(const Medium& air, const SolvedLight& light, double altitude_km, double thickness_km,
             EnergyBalance& balance) {
    const double r = air.ground_radius_km + altitude_km;
    const double area = 2 * kPi * r * r * thickness_km;  // of a strip of suns, per cosine
    const Coefficients here = coefficients_at(air, altitude_km);
    const double edge = -horizon_distance_km(shell_of(air), altitude_km) / r;
    for_suns(edge, 1, [&](double cosine, double weight) {
        const Spectrum sun = sunlight(air, altitude_km, cosine);
        balance.in += area * weight * here.scattering_per_km * sun;
    });
    for_all_suns(light.suns, [&](double cosine, double weight) {
        const Spectrum mean = light.mean_radiance_at(altitude_km, cosine);
        const Spectrum absorption = here.extinction_per_km - here.scattering_per_km;
        balance.absorbed += area * weight * absorption * 4.0 * kPi * mean;
    });
}

void add_ground(const Medium& air, const SolvedLight& light, EnergyBalance& balance) {
    const double area = 2 * kPi * air.ground_radius_km * air.ground_radius_km;
    for_suns(0, 1, [&](double cosine, double weight) {
        balance.in += area * weight * (sunlight(air, 0, cosine) * (air.ground_albedo * cosine));
    });
    for_all_suns(light.suns, [&](double cosine, double weight) {
        balance.absorbed +=
            area * weight * (light.sky_irradiance_at(cosine) * (1.0 - air.ground_albedo));
    });
}

void add_top(const Medium& air, const SolvedLight& light, EnergyBalance& balance) {
    const double area = 2 * kPi * air.top_radius_km() * air.top_radius_km();
    std::vector<Spectrum> moments(static_cast<std::size_t>(moment_count(light.degree())));
    // Nothing comes from above, so the first moment along the vertical is minus the upward flux.
    const Spectrum& vertical = moments[static_cast<std::size_t>(moment_index(1, 0))];
    const double norm = harmonic_norm(1, 0);
    for_all_suns(light.suns, [&](double cosine, double weight) {
        light.moments_at(air.thickness_km, cosine, moments.data());
        balance.escaped -= area * weight * vertical / norm;
    });
}

// The light that goes in and out may differ by this share: ten times as much as Earth's does.
constexpr double kEnergyTolerance = 0.03;
constexpr double kMostLeftOut = 0.01;

}  // namespace

double EnergyBalance::largest_error() const {
    double error = 0;
    for (std::size_t c = 0; c < kMaxChannels; ++c) {
        if (in[c] > 0) error = std::max(error, std::fabs(in[c] - escaped[c] - absorbed[c]) / in[c]);
    }
    return error;
}

EnergyBalance energy_balance(const SkyMedium& medium, const SolvedLight& light) {
    static const QuadratureRule rule = gauss_legendre(kLevelNodes);
    EnergyBalance balance;
    for (std::size_t i = 0; i + 1 < light.altitudes_km.size(); ++i) {
        const double gap = light.altitudes_km[i + 1] - light.altitudes_km[i];
        for (std::size_t k = 0; k < rule.nodes.size(); ++k) {
            add_air(medium.air, light, light.altitudes_km[i] + gap * rule.nodes[k],
                    gap * rule.weights[k], balance);
        }
    }
    add_ground(medium.air, light, balance);
    add_top(medium.air, light, balance);
    return balance;
}

std::optional<Diagnostic> check_light(const EnergyBalance& balance, const SolvedLight& light,
                                      const std::string& name) {
    if (!(light.left_out <= kMostLeftOut)) {
        return diagnosis(
            "E0405",
            fmt::format(
                "`{}`: after {} orders of scattering {:.2g} of the light is still missing, more "
                "than "
                "{:.2g}: air this dense, or a phase function this sharp, is beyond the solver",
                name, light.applications + 1, light.left_out, kMostLeftOut));
    }
    if (!(balance.largest_error() <= kEnergyTolerance)) {
        return diagnosis(
            "E0405",
            fmt::format(
                "`{}`: a share of {:.3g} of the light that enters is not accounted for, more than "
                "{:.3g}: air this dense, or a phase function this sharp, is beyond the solver",
                name, balance.largest_error(), kEnergyTolerance));
    }
    for (int level = 0; level < light.light.levels; ++level) {
        for (int sun = 0; sun < light.light.suns; ++sun) {
            const double* mean = light.light.at(level, sun);
            if (*std::min_element(mean, mean + kMaxChannels) >= 0) continue;
            return diagnosis(
                "E0405",
                fmt::format("`{}`: light at altitude_km {:.6g}, sun_cos_zenith {:.6g} is negative",
                            name, light.altitudes_km[static_cast<std::size_t>(level)],
                            light.suns.cosines[static_cast<std::size_t>(sun)]));
        }
    }
    return std::nullopt;
}

}  // namespace skybake
