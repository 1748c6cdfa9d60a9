#include "bakers/assets/cloud_light/cloud_scattering.h"

#include <cstddef>

#include "config/sections/layer.h"

namespace skybake::cloud_light {

CloudScattering scattering_of(const CloudPhase& phase, double albedo) {
    PhaseFunction peak = make_phase_function(config::Phase::henyey_greenstein, phase.hg_g);
    PhaseFunction wide = make_phase_function(config::Phase::henyey_greenstein, phase.draine_g);
    const double g = phase.draine_g;
    const double alpha = phase.draine_alpha;
    wide.constant /= 1 + alpha * (1 + 2 * g * g) / 3;
    wide.quadratic = alpha * wide.constant;
    return {{{1 - phase.draine_share, peak}, {phase.draine_share, wide}}, albedo};
}

double phase_value(const CloudScattering& scattering, double one_minus, double one_plus) {
    double sum = 0;
    for (const ScatteringLobe& lobe : scattering.lobes) {
        sum += lobe.share * phase_value(lobe.phase, one_minus, one_plus);
    }
    return sum;
}

std::vector<double> moments_of(const CloudScattering& scattering, int degree) {
    std::vector<double> sum(static_cast<std::size_t>(degree) + 1, 0.0);
    for (const ScatteringLobe& lobe : scattering.lobes) {
        const std::vector<double> moments = legendre_moments(lobe.phase, degree);
        for (std::size_t l = 0; l < sum.size(); ++l) sum[l] += lobe.share * moments[l];
    }
    return sum;
}

ScaledScattering scaled(const CloudScattering& scattering, int degree) {
    std::vector<double> moments = moments_of(scattering, degree + 1);
    const double peak = moments.back();
    moments.pop_back();
    ScaledScattering result;
    result.extinction_share = 1 - scattering.albedo * peak;
    for (const double moment : moments) {
        result.returned.push_back(scattering.albedo * (moment - peak) / result.extinction_share);
    }
    return result;
}

}  // namespace skybake::cloud_light
