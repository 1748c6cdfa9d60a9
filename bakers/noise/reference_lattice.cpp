#include "bakers/noise/reference_lattice.h"

#include <algorithm>
#include <cstddef>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec4.hpp>
#include <limits>

namespace skybake::noise::reference {
namespace {

double quintic(double t) { return t * t * t * (t * (t * 6 - 15) + 10); }
double fade_slope(double t) { return 30 * t * t * (t - 1) * (t - 1); }

// The sum over the corners of (g . d) W, with W a product of one weight per axis, and of its
// derivatives.
template <class Vector>
Dual sum_over_corners(const Lattice& lattice, const Vector& position) {
    const Vector cell = glm::floor(position);
    const Vector t = position - cell;
    std::array<Vector, 2> weight, slope;  // of the lower and of the upper side along each axis
    for (glm::length_t axis = 0; axis < Vector::length(); ++axis) {
        weight[1][axis] = quintic(t[axis]);
        slope[1][axis] = fade_slope(t[axis]);
    }
    weight[0] = 1.0 - weight[1];
    slope[0] = -slope[1];
    Dual result;
    for (unsigned corner = 0; corner < 1U << Vector::length(); ++corner) {
        Vector side;
        for (glm::length_t axis = 0; axis < Vector::length(); ++axis)
            side[axis] = corner >> axis & 1;
        const Vector gradient = lattice.gradient(cell + side);
        const double ramp = glm::dot(gradient, t - side);
        // Products of the weights along all axes, and along those but one.
        double product = 1;
        glm::dvec3 slopes(1);
        for (glm::length_t axis = 0; axis < Vector::length(); ++axis) {
            const std::size_t upper = corner >> axis & 1;
            product *= weight[upper][axis];
            for (glm::length_t i = 0; i < 3; ++i) {
                slopes[i] *= i == axis ? slope[upper][axis] : weight[upper][axis];
            }
        }
        result.value += ramp * product;
        result.slope += glm::dvec3(gradient) * product + ramp * slopes;
    }
    return result;
}

// Calls take(distance, height of the bump) for the points of 125 cells.
template <class Take>
void for_points(const Lattice& lattice, const glm::dvec3& place, const Take& take) {
    const glm::dvec3 position = place * lattice.periods();
    const glm::dvec3 cell = glm::floor(position);
    for (int k = -2; k <= 2; ++k) {
        for (int j = -2; j <= 2; ++j) {
            for (int i = -2; i <= 2; ++i) {
                const CellPoint point = lattice.point(cell[0] + i, cell[1] + j, cell[2] + k);
                const glm::dvec3 at = cell + glm::dvec3(i, j, k);
                take(glm::distance(at + glm::dvec3(point.x, point.y, point.z), position),
                     point.height);
            }
        }
    }
}

}  // namespace

CellPoint Lattice::point(double x, double y, double z) const {
    PathShift shift;
    if (loops) {
        const auto along = [&](int count) {
            const double paths = *loops * count;
            return static_cast<std::uint32_t>((paths - std::floor(paths)) * kPathSteps);
        };
        const int slow = time_period < 4 ? 1 : time_period / 2;
        shift = {along(slow), along(slow + 1)};
    }
    return cell_point(row_key(key, wrap(y, 1), wrap(z, 2)), wrap(x, 0), shift);
}

Dual improved_noise(const Lattice& lattice, const glm::dvec3& place) {
    const glm::dvec3 position = place * lattice.periods();
    if (!lattice.loops) return sum_over_corners(lattice, position);
    return sum_over_corners(lattice, glm::dvec4(position, *lattice.loops * lattice.time_period));
}

std::array<double, 2> nearest_points(const Lattice& lattice, const glm::dvec3& place) {
    std::array<double, 2> nearest = {std::numeric_limits<double>::infinity(),
                                     std::numeric_limits<double>::infinity()};
    for_points(lattice, place, [&](double distance, double) {
        if (distance < nearest[0]) {
            nearest = {distance, nearest[0]};
        } else {
            nearest[1] = std::min(nearest[1], distance);
        }
    });
    return nearest;
}

double alligator(const Lattice& lattice, const glm::dvec3& place) {
    std::array<double, 2> greatest = {0, 0};
    for_points(lattice, place, [&](double distance, double height) {
        if (distance >= 1) return;
        const double t = 1 - distance;
        const double bump = height * (3 * t * t - 2 * t * t * t);
        if (bump > greatest[0]) {
            greatest = {bump, greatest[0]};
        } else {
            greatest[1] = std::max(greatest[1], bump);
        }
    });
    return greatest[0] - greatest[1];
}

}  // namespace skybake::noise::reference
