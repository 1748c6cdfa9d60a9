#include "bakers/light/path_tracer/phase_sampling.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "bakers/math/transcendental.h"

namespace skybake {

namespace {

// Newton's steps converge quadratically: after one below this the root has all its digits. From the
// end of a cubic it takes six for a = b.
constexpr double kLastStep = 1e-8;
constexpr int kMostNewtonSteps = 64;

ScatteringAngle sample_henyey_greenstein(double g, double uniform) {
    const double one_minus_s = 2 * (1 - uniform);
    const double one_plus_s = 2 * uniform;
    // 1 + g s from the end where it is smaller.
    const double root = g < 0 ? (1 + g) - g * one_minus_s : (1 - g) + g * one_plus_s;
    const double scale = 0.5 / (root * root);
    return {scale * (1 - g) * (1 - g) * one_minus_s * (2 + g * one_plus_s),
            scale * (1 + g) * (1 + g) * one_plus_s * (2 - g * one_minus_s)};
}

// Inverts a distribution with the density (a + b nu^2) 2 pi, whose integral is 1: a cubic. It rises
// by at least 2 pi a for each unit of nu, and is convex for nu > 0, where Newton's steps from the
// right end come down to the root without passing it.
ScatteringAngle sample_quadratic(double a, double b, double share) {
    const double half = std::fabs(share - 0.5);  // the integral from 0 to |nu|
    const double whole = a + b / 3;
    const double target = 2 * half * whole;
    double nu = 1;
    for (int i = 0; i < kMostNewtonSteps; ++i) {
        const double square = nu * nu;
        const double step = (nu * (a + b / 3 * square) - target) / (a + b * square);
        nu -= step;
        if (step <= kLastStep) break;
    }
    nu = std::copysign(nu, share - 0.5);
    return {1 - nu, 1 + nu};
}

}  // namespace

ScatteringAngle sample_phase(const PhaseFunction& phase, double share, RandomStream& random) {
    if (phase.table) return sample_tabulated_phase(*phase.table, share);
    if (phase.g == 0 && phase.quadratic != 0) {
        return sample_quadratic(phase.constant, phase.quadratic, share);
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
    // An orthonormal basis without a branch on small components: Duff et al. 2017.
    const double sign = std::copysign(1.0, direction.z);
    const double a = -1 / (sign + direction.z);
    const double b = direction.x * direction.y * a;
    const glm::dvec3 first = {1 + sign * direction.x * direction.x * a, sign * b,
                              -sign * direction.x};
    const glm::dvec3 second = {b, sign + direction.y * direction.y * a, -direction.y};
    const double sine = std::sqrt(cosine.one_minus * cosine.one_plus);
    const double nu = 0.5 * (cosine.one_plus - cosine.one_minus);
    const SineCosine azimuth = sine_and_cosine(2 * std::numbers::pi * turn);
    const glm::dvec3 result =
        nu * direction + sine * azimuth.cosine * first + sine * azimuth.sine * second;
    // Rounding of thousands of scatterings would add up.
    return (1 / std::sqrt(glm::dot(result, result))) * result;
}

}  // namespace skybake
