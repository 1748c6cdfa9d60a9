#include "bakers/math/harmonics.h"

#include <cmath>
#include <numbers>

namespace skybake {
namespace {

// The square roots of the norms: sqrt(n / pi) / d.
double norm(double n, double d) { return std::sqrt(n / std::numbers::pi) / d; }

}  // namespace

Harmonics harmonics(const glm::dvec3& d) {
    const double x2 = d.x * d.x;
    const double y2 = d.y * d.y;
    const double z2 = d.z * d.z;
    const double first = norm(3, 2);
    const double second = norm(15, 2);
    const double third = norm(35.0 / 2, 4);
    const double fourth = norm(21.0 / 2, 4);
    return {norm(1, 2),
            first * d.y,
            first * d.z,
            first * d.x,
            second * d.x * d.y,
            second * d.y * d.z,
            norm(5, 4) * (3 * z2 - 1),
            second * d.x * d.z,
            second / 2 * (x2 - y2),
            third * d.y * (3 * x2 - y2),
            norm(105, 2) * d.x * d.y * d.z,
            fourth * d.y * (5 * z2 - 1),
            norm(7, 4) * d.z * (5 * z2 - 3),
            fourth * d.x * (5 * z2 - 1),
            norm(105, 4) * d.z * (x2 - y2),
            third * d.x * (x2 - 3 * y2)};
}

std::size_t degree_of_harmonic(std::size_t coefficient) {
    std::size_t degree = 0;
    while ((degree + 1) * (degree + 1) <= coefficient) ++degree;
    return degree;
}

}  // namespace skybake
