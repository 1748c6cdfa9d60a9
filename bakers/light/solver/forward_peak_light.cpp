#include "bakers/light/solver/first_light.h"

#include <algorithm>
#include <cstddef>
#include <numbers>

#include "bakers/air/optical_depth.h"
#include "bakers/air/ray.h"
#include "bakers/light/solver/solved_light.h"
#include "bakers/math/quadrature.h"
#include "bakers/math/transcendental.h"

namespace skybake {
namespace {

SplitPhase split(const SkyLayer& layer, int degree) {
    SplitPhase result;
    if (largest(layer.forward_share) > 0) {
        result.series = scattered_moments(layer, degree);
        for (std::size_t l = 0; l < result.series.size(); ++l) {
            result.series[l] *= (2 * static_cast<double>(l) + 1) / (4 * std::numbers::pi);
        }
        return result;
    }
    const LayerPhase& phase = layer.phase;
    result.wide = without_peak(phase);
    if (!result.wide.has_peak) return result;
    const std::vector<Spectrum> whole = legendre_moments(phase, degree);
    const std::vector<Spectrum> rest = legendre_moments(result.wide.phase, degree);
    for (std::size_t l = 0; l < whole.size(); ++l) {
        result.peak.push_back(whole[l] - result.wide.share * rest[l]);
    }
    return result;
}

// The clamped cosine max(mu, 0) is the sum of these coefficients times P_l(mu): (2 l + 1) / 2 times
// the integral of mu P_l(mu) from 0 to 1.
std::vector<double> clamped_cosine_series(int degree) {
    std::vector<double> series(static_cast<std::size_t>(degree) + 1);
    const QuadratureRule rule = gauss_legendre(degree / 2 + 2);
    std::vector<double> harmonics(static_cast<std::size_t>(moment_count(degree)));
    for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
        zenith_harmonics(degree, rule.nodes[i], harmonics.data());
        for (int l = 0; l <= degree; ++l) {
            const double legendre =
                harmonics[static_cast<std::size_t>(moment_index(l, 0))] / harmonic_norm(l, 0);
            series[static_cast<std::size_t>(l)] +=
                0.5 * (2 * l + 1) * rule.weights[i] * rule.nodes[i] * legendre;
        }
    }
    return series;
}

// Returns the irradiance of level ground by light with these Legendre moments about the sun's
// direction. `series` is that of the clamped cosine; it is empty if all light comes from next to the
// sun.
Spectrum irradiance_of(const std::vector<Spectrum>& light, double sun_cos_zenith,
                       const std::vector<double>& series) {
    if (series.empty()) return std::max(sun_cos_zenith, 0.0) * light[0];
    const auto degree = static_cast<int>(light.size()) - 1;
    std::vector<double> harmonics(static_cast<std::size_t>(moment_count(degree)));
    zenith_harmonics(degree, sun_cos_zenith, harmonics.data());
    Spectrum sum{};
    for (int l = 0; l <= degree; ++l) {
        const auto at = static_cast<std::size_t>(l);
        sum += series[at] * harmonics[static_cast<std::size_t>(moment_index(l, 0))] /
               harmonic_norm(l, 0) * light[at];
    }
    return sum;
}

}  // namespace

std::vector<SplitPhase> split_phases(const SkyMedium& medium, int degree) {
    if (degree > kLargestDegreeOfBundles) return phases_from_sun(medium, degree);
    std::vector<SplitPhase> phases;
    for (const SkyLayer& layer : medium.layers) phases.push_back(split(layer, degree));
    return phases;
}

std::vector<SplitPhase> phases_from_sun(const SkyMedium& medium, int degree) {
    std::vector<SplitPhase> phases;
    for (const SkyLayer& layer : medium.layers) {
        phases.push_back(split(layer, degree));
        phases.back().peak = scattered_moments(layer, degree);
        phases.back().is_taken_from_sun = true;
    }
    return phases;
}

Spectrum forward_light(const SkyMedium& medium, const SkyLayer& layer, double altitude_km,
                       double sun_cos_zenith) {
    const double s_km = (medium.air.ground_radius_km + altitude_km) * sun_cos_zenith;
    if (!layer.scatters || s_km < -horizon_distance_km(shell_of(medium.air), altitude_km)) {
        return {};
    }
    return exponential(-optical_depth_to_top(medium.air, altitude_km, s_km)) *
           scattering_depth(layer, altitude_km, s_km);
}

void add_forward_peaks(const SkyMedium& medium, const std::vector<SplitPhase>& phases,
                       double altitude_km, const SunAxis& suns, int degree, double* out,
                       double* sky_irradiance) {
    if (std::ranges::all_of(phases, [](const SplitPhase& phase) { return phase.peak.empty(); })) {
        return;
    }
    const auto orders = static_cast<std::size_t>(moment_count(degree));
    const bool narrow = sky_irradiance == nullptr || !phases.front().is_taken_from_sun;
    const std::vector<double> series =
        narrow ? std::vector<double>() : clamped_cosine_series(degree);
    for (std::size_t sun = 0; sun < suns.cosines.size(); ++sun) {
        const double mu = suns.cosines[sun];
        std::vector<Spectrum> light(static_cast<std::size_t>(degree) + 1);  // by l
        for (std::size_t k = 0; k < phases.size(); ++k) {
            if (phases[k].peak.empty()) continue;
            const Spectrum whole = forward_light(medium, medium.layers[k], altitude_km, mu);
            for (std::size_t l = 0; l < light.size(); ++l) light[l] += whole * phases[k].peak[l];
        }
        add_light_about_sun(light, mu, out + sun * orders * kChannelSlots);
        if (sky_irradiance == nullptr) continue;
        const Spectrum irradiance = irradiance_of(light, mu, series);
        for (std::size_t c = 0; c < kMaxChannels; ++c) {
            sky_irradiance[sun * kChannelSlots + c] += irradiance[c];
        }
    }
}

}  // namespace skybake
