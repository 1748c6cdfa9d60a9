#include "bakers/air/cloud_phase.h"

#include <algorithm>

#include "bakers/air/particles/phase_function.h"
#include "bakers/math/transcendental.h"
#include "config/sections/cloud.h"

namespace skybake {

CloudPhase droplet_phase(double diameter_um) {
    const double d = diameter_um;
    return {exponential(-0.0990567 / (d - 1.67154)),
            exponential(-2.20679 / (d + 3.91029) - 0.428934),
            exponential(3.62489 - 8.29288 / (d + 5.52825)),
            exponential(-0.599085 / (d - 0.641583) - 0.665888)};
}

// The paper gives the mean cosine g of all light as a polynomial of the diameter, and the backward function.
CloudPhase ice_phase() {
    constexpr double kDiameter_um = 50;
    constexpr double kBackward = -0.65;
    constexpr double kBackwardShare = 0.01;
    constexpr double g =
        0.755577 +
        kDiameter_um * (4.77827e-4 + kDiameter_um * (-7.4097e-6 + kDiameter_um * 3.66023e-8));
    return {(g - kBackwardShare * kBackward) / (1 - kBackwardShare), kBackward, 0, kBackwardShare};
}

CloudPhase cloud_phase(config::CloudParticles particles, double droplet_diameter_um) {
    return particles == config::CloudParticles::ice ? ice_phase()
                                                    : droplet_phase(droplet_diameter_um);
}

CloudPhase widened(const CloudPhase& phase, double eccentricity) {
    return {phase.hg_g * eccentricity, phase.draine_g * eccentricity,
            phase.draine_alpha * eccentricity, phase.draine_share};
}

double phase_value(const CloudPhase& phase, double offset) {
    return (1 - phase.draine_share) * henyey_greenstein(phase.hg_g, offset, 2 - offset) +
           phase.draine_share * draine(phase.draine_g, phase.draine_alpha, offset, 2 - offset);
}

// The mean cosine of Draine's function follows from the moments of Henyey-Greenstein's: g for u, (1
// + 2 g^2) / 3 for u^2 and (3 g + 2 g^3) / 5 for u^3.
double mean_cosine(const CloudPhase& phase) {
    const double g = phase.draine_g;
    const double alpha = phase.draine_alpha;
    const double draine = g * (1 + alpha * (3 + 2 * g * g) / 5) / (1 + alpha * (1 + 2 * g * g) / 3);
    return (1 - phase.draine_share) * phase.hg_g + phase.draine_share * draine;
}

double backward_share(const CloudPhase& phase) { return 1 - mean_cosine(phase); }

CloudOptics cloud_optics(const Cloud& cloud) {
    return {cloud.extinction_scale.per_meter, cloud.threshold_at == config::ThresholdAt::runtime,
            cloud.threshold, cloud.edge_softness, cloud.particles};
}

double density(const CloudOptics& optics, double value) {
    const double threshold = optics.has_edge ? optics.threshold : 0.0;
    if (!(value > threshold)) return 0;
    if (!optics.has_edge || optics.edge_softness == 0) return value;
    const double x = std::min((value - threshold) / optics.edge_softness, 1.0);
    return value * (x * x * (3 - 2 * x));
}

}  // namespace skybake
