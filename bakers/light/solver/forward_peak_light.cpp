#include "bakers/light/solver/first_light.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "bakers/air/optical_depth.h"
#include "bakers/air/ray.h"
#include "bakers/light/solver/solved_light.h"
#include "bakers/math/transcendental.h"

namespace skybake {

namespace {

SplitPhase split(const LayerPhase& phase, int degree) {
    SplitPhase result;
    result.wide = without_peak(phase);
    if (!result.wide.has_peak) return result;
    const std::vector<Spectrum> whole = legendre_moments(phase, degree);
    const std::vector<Spectrum> rest = legendre_moments(result.wide.phase, degree);
    for (std::size_t l = 0; l < whole.size(); ++l) {
        result.peak.push_back(whole[l] - result.wide.share * rest[l]);
    }
    return result;
}

// Scattering as a share of extinction, the same at all altitudes of one layer.
Spectrum single_scattering_albedo(const Medium& alone) {
    const bool is_exponential = !alone.exponential_layers.empty();
    const Spectrum& scattering = is_exponential ? alone.exponential_layers[0].scattering_per_km
                                                : alone.piecewise_layers[0].scattering_per_km;
    const Spectrum& extinction = is_exponential ? alone.exponential_layers[0].extinction_per_km
                                                : alone.piecewise_layers[0].extinction_per_km;
    return share_of(scattering, extinction);
}

}  // namespace

std::vector<SplitPhase> split_phases(const SkyMedium& medium, int degree) {
    std::vector<SplitPhase> phases;
    for (const SkyLayer& layer : medium.layers) phases.push_back(split(layer.phase, degree));
    return phases;
}

void add_forward_peaks(const SkyMedium& medium, const std::vector<SplitPhase>& phases,
                       double altitude_km, const SunAxis& suns, int degree, double* out,
                       double* sky_irradiance) {
    if (std::all_of(phases.begin(), phases.end(),
                    [](const SplitPhase& phase) { return phase.peak.empty(); })) {
        return;
    }
    const double r = medium.air.ground_radius_km + altitude_km;
    const double horizon_km = horizon_distance_km(shell_of(medium.air), altitude_km);
    const auto orders = static_cast<std::size_t>(moment_count(degree));
    std::vector<double> harmonics(orders);
    for (std::size_t sun = 0; sun < suns.cosines.size(); ++sun) {
        const double mu = suns.cosines[sun];
        if (r * mu < -horizon_km) continue;
        const Spectrum passed = exponential(-optical_depth_to_top(medium.air, altitude_km, r * mu));
        std::vector<Spectrum> light(static_cast<std::size_t>(degree) + 1);  // by l
        for (std::size_t k = 0; k < phases.size(); ++k) {
            if (phases[k].peak.empty() || !medium.layers[k].scatters) continue;
            const Medium& alone = medium.layers[k].alone;
            const Spectrum albedo = single_scattering_albedo(alone);
            const Spectrum own = optical_depth_to_top(alone, altitude_km, r * mu);
            for (std::size_t l = 0; l < light.size(); ++l) {
                light[l] += passed * albedo * own * phases[k].peak[l];
            }
        }
        zenith_harmonics(degree, mu, harmonics.data());
        const double sine = std::sqrt((1 - mu) * (1 + mu));
        double* to = out + sun * orders * kChannelSlots;
        double factor = 1;  // moments of order m are kept over sin^m theta_s
        for (int m = 0; m <= degree; ++m) {
            for (int l = m; l <= degree; ++l) {
                const auto lm = static_cast<std::size_t>(moment_index(l, m));
                for (std::size_t c = 0; c < kMaxChannels; ++c) {
                    to[lm * kChannelSlots + c] +=
                        factor * harmonics[lm] * light[static_cast<std::size_t>(l)][c];
                }
            }
            factor /= sine;
        }
        for (std::size_t c = 0; sky_irradiance && c < kMaxChannels; ++c) {
            sky_irradiance[sun * kChannelSlots + c] += std::max(mu, 0.0) * light[0][c];
        }
    }
}

}  // namespace skybake
