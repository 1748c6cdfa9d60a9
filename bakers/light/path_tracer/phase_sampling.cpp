#include "bakers/light/path_tracer/phase_sampling.h"

#include "bakers/light/path_tracer/path_steps-inl.h"

namespace skybake {

namespace kernel = HWY_NAMESPACE;

namespace {

ScatteringAngle sample_henyey_greenstein(double g, double uniform) {
    const double one_minus_s = 2 * (1 - uniform);
    const double one_plus_s = 2 * uniform;
    // 1 + g s from the end where it is smaller.
    const double root = g < 0 ? (1 + g) - g * one_minus_s : (1 - g) + g * one_plus_s;
    const double scale = 0.5 / (root * root);
    return {scale * (1 - g) * (1 - g) * one_minus_s * (2 + g * one_plus_s),
            scale * (1 + g) * (1 + g) * one_plus_s * (2 - g * one_minus_s)};
}

}  // namespace

ScatteringAngle sample_phase(const PhaseFunction& phase, double share, RandomStream& random) {
    if (phase.table) return sample_tabulated_phase(*phase.table, share);
    if (is_quadratic(phase)) {
        const auto angle = kernel::sample_quadratic(phase.constant, phase.quadratic, share);
        return {angle.one_minus, angle.one_plus};
    }
    for (;; share = random.next()) {
        const ScatteringAngle cosine = sample_henyey_greenstein(phase.g, share);
        if (phase.quadratic == 0) return cosine;
        const double nu = 0.5 * (cosine.one_plus - cosine.one_minus);
        const double accepted = phase.constant + phase.quadratic * nu * nu;
        if (random.next() * (phase.constant + phase.quadratic) < accepted) return cosine;
    }
}

glm::dvec3 scatter(const glm::dvec3& direction, const ScatteringAngle& cosine, double turn) {
    const kernel::Direction<double> after = kernel::scatter<double>(
        {direction.x, direction.y, direction.z}, {cosine.one_minus, cosine.one_plus}, turn);
    return {after.x, after.y, after.z};
}

}  // namespace skybake
