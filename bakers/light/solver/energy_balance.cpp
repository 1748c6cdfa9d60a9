#include "bakers/light/solver/energy_balance.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include "bakers/air/optical_depth.h"
#include "bakers/math/gauss_legendre.h"
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

// As for_suns, over all that have light.
template <class Visit>
void for_all_suns(const SunAxis& axis, const Visit& visit) {
    for_suns(axis.centre, 1, visit);
    for_suns(axis.centre, axis.darkest,
             [&](double cosine, double weight) { visit(cosine, -weight); });
}

void add(Spectrum& sum, double weight, const Spectrum& value) {
    for (std::size_t c = 0; c < sum.size(); ++c) sum[c] += weight * value[c];
}

Spectrum sunlight(const Medium& air, double altitude_km, double sun_cos_zenith) {
    const double r = air.ground_radius_km + altitude_km;
    Spectrum value = optical_depth_to_top(air, altitude_km, r * sun_cos_zenith);
    for (std::size_t c = 0; c < static_cast<std::size_t>(air.channels); ++c) {
        value[c] = exponential(-value[c]);
    }
    return value;
}

void add_air(const Medium& air, const SolvedLight& light, double altitude_km, double thickness_km,
             EnergyBalance& balance) {
    const double r = air.ground_radius_km + altitude_km;
    const double area = 2 * kPi * r * r * thickness_km;  // of a strip of suns, per cosine
    const Coefficients here = coefficients_at(air, altitude_km);
    const double edge = -horizon_distance_km(shell_of(air), altitude_km) / r;
    for_suns(edge, 1, [&](double cosine, double weight) {
        const Spectrum sun = sunlight(air, altitude_km, cosine);
        for (std::size_t c = 0; c < sun.size(); ++c) {
            balance.in[c] += area * weight * here.scattering_per_km[c] * sun[c];
        }
    });
    for_all_suns(light.suns, [&](double cosine, double weight) {
        const Spectrum mean = light.mean_radiance_at(altitude_km, cosine);
        for (std::size_t c = 0; c < mean.size(); ++c) {
            const double absorption = here.extinction_per_km[c] - here.scattering_per_km[c];
            balance.absorbed[c] += area * weight * absorption * 4 * kPi * mean[c];
        }
    });
}

void add_ground(const Medium& air, const SolvedLight& light, EnergyBalance& balance) {
    const double area = 2 * kPi * air.ground_radius_km * air.ground_radius_km;
    for_suns(0, 1, [&](double cosine, double weight) {
        Spectrum sun = sunlight(air, 0, cosine);
        for (std::size_t c = 0; c < sun.size(); ++c) sun[c] *= air.ground_albedo[c] * cosine;
        add(balance.in, area * weight, sun);
    });
    for_all_suns(light.suns, [&](double cosine, double weight) {
        Spectrum sky = light.sky_irradiance_at(cosine);
        for (std::size_t c = 0; c < sky.size(); ++c) sky[c] *= 1 - air.ground_albedo[c];
        add(balance.absorbed, area * weight, sky);
    });
}

void add_top(const Medium& air, const SolvedLight& light, EnergyBalance& balance) {
    const double area = 2 * kPi * air.top_radius_km() * air.top_radius_km();
    std::vector<double> moments(static_cast<std::size_t>(moment_count(light.degree())) *
                                kMaxChannels);
    // Nothing comes from above, so the first moment along the vertical is minus the upward flux.
    const auto vertical = static_cast<std::size_t>(moment_index(1, 0)) * kMaxChannels;
    const double norm = harmonic_norm(1, 0);
    for_all_suns(light.suns, [&](double cosine, double weight) {
        light.moments_at(air.thickness_km, cosine, moments.data());
        for (std::size_t c = 0; c < kMaxChannels; ++c) {
            balance.escaped[c] -= area * weight * moments[vertical + c] / norm;
        }
    });
}

}  // namespace

double EnergyBalance::largest_error() const {
    double error = 0;
    for (std::size_t c = 0; c < in.size(); ++c) {
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

}  // namespace skybake
