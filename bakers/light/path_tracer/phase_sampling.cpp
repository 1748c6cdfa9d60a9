#include "bakers/light/path_tracer/phase_sampling.h"

#include <cmath>
#include <glm/geometric.hpp>

namespace skybake {

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

// A point of the unit circle: of uniform points in the square, the first within the circle.
struct CirclePoint {
    double cosine;
    double sine;
};

CirclePoint sample_circle(RandomStream& random) {
    for (;;) {
        const double x = 2 * random.next() - 1;
        const double y = 2 * random.next() - 1;
        const double square = x * x + y * y;
        // Points next to the centre have too few digits for a direction.
        if (square > 1 || square < 0x1p-40) continue;
        const double inverse = 1 / std::sqrt(square);
        return {x * inverse, y * inverse};
    }
}

}  // namespace

ScatteringAngle sample_phase(const PhaseFunction& phase, RandomStream& random) {
    if (phase.table) return sample_tabulated_phase(*phase.table, random.next());
    for (;;) {
        const ScatteringAngle cosine = sample_henyey_greenstein(phase.g, random.next());
        if (phase.quadratic == 0) return cosine;
        const double nu = 0.5 * (cosine.one_plus - cosine.one_minus);
        const double accepted = phase.constant + phase.quadratic * nu * nu;
        if (random.next() * (phase.constant + phase.quadratic) < accepted) return cosine;
    }
}

glm::dvec3 scatter(const glm::dvec3& direction, const ScatteringAngle& cosine,
                   RandomStream& random) {
    // An orthonormal basis without a branch on small components: Duff et al. 2017.
    const double sign = std::copysign(1.0, direction.z);
    const double a = -1 / (sign + direction.z);
    const double b = direction.x * direction.y * a;
    const glm::dvec3 first = {1 + sign * direction.x * direction.x * a, sign * b,
                              -sign * direction.x};
    const glm::dvec3 second = {b, sign + direction.y * direction.y * a, -direction.y};
    const CirclePoint circle = sample_circle(random);
    const double sine = std::sqrt(cosine.one_minus * cosine.one_plus);
    const double nu = 0.5 * (cosine.one_plus - cosine.one_minus);
    const glm::dvec3 result =
        nu * direction + sine * circle.cosine * first + sine * circle.sine * second;
    // Rounding of thousands of scatterings would add up.
    return (1 / std::sqrt(glm::dot(result, result))) * result;
}

}  // namespace skybake
