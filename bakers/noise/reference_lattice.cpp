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
double lerp(double a, double b, double t) { return a + t * (b - a); }

// With the chain rule written out.
Dual improved_noise_3(const Lattice& lattice, const glm::dvec3& place) {
    const glm::dvec3 position = place * lattice.periods();
    const glm::dvec3 cell = glm::floor(position);
    const glm::dvec3 t = position - cell;
    const glm::dvec3 w = {quintic(t.x), quintic(t.y), quintic(t.z)};
    double value[2][2][2];
    double slope[3][2][2][2];
    for (int k = 0; k < 2; ++k) {
        for (int j = 0; j < 2; ++j) {
            for (int i = 0; i < 2; ++i) {
                const Gradient g = lattice.gradient(cell[0] + i, cell[1] + j, cell[2] + k);
                value[k][j][i] = g.x * (t[0] - i) + g.y * (t[1] - j) + g.z * (t[2] - k);
                slope[0][k][j][i] = g.x;
                slope[1][k][j][i] = g.y;
                slope[2][k][j][i] = g.z;
            }
        }
    }
    const auto blended = [&](const double(&corner)[2][2][2]) {
        const double near = lerp(lerp(corner[0][0][0], corner[0][0][1], w[0]),
                                 lerp(corner[0][1][0], corner[0][1][1], w[0]), w[1]);
        const double far = lerp(lerp(corner[1][0][0], corner[1][0][1], w[0]),
                                lerp(corner[1][1][0], corner[1][1][1], w[0]), w[1]);
        return lerp(near, far, w[2]);
    };
    Dual result;
    result.value = blended(value);
    // d/dx sum(n_i W_i) = sum(dn_i/dx W_i) + sum(n_i dW_i/dx): the second part is a blend of
    // differences across the axis.
    double across[3] = {0, 0, 0};
    for (int a = 0; a < 2; ++a) {
        for (int b = 0; b < 2; ++b) {
            const double wy = a != 0 ? w[1] : 1 - w[1];
            const double wz = b != 0 ? w[2] : 1 - w[2];
            const double wx = a != 0 ? w[0] : 1 - w[0];
            const double wy_second = b != 0 ? w[1] : 1 - w[1];
            across[0] += (value[b][a][1] - value[b][a][0]) * wy * wz;
            across[1] += (value[b][1][a] - value[b][0][a]) * wx * wz;
            across[2] += (value[1][b][a] - value[0][b][a]) * wx * wy_second;
        }
    }
    for (std::size_t i = 0; i < 3; ++i) {
        result.slope[i] = blended(slope[i]) + across[i] * fade_slope(t[i]);
    }
    return result;
}

// The sum over the sixteen corners of (g . d) W, with W a product of one weight per axis, and of its
// derivatives.
Dual improved_noise_4(const Lattice& lattice, const glm::dvec3& place) {
    const glm::dvec4 position(place * lattice.periods(), *lattice.loops * lattice.time_period);
    const glm::dvec4 cell = glm::floor(position);
    const glm::dvec4 t = position - cell;
    Dual result;
    for (int corner = 0; corner < 16; ++corner) {
        const glm::dvec4 side(corner & 1, corner >> 1 & 1, corner >> 2 & 1, corner >> 3);
        const glm::dvec4 at = cell + side;
        const Gradient4 hashed = lattice.gradient(at.x, at.y, at.z, at.w);
        const glm::dvec4 gradient(hashed.x, hashed.y, hashed.z, hashed.t);
        const double ramp = glm::dot(gradient, t - side);
        glm::dvec4 weight;
        glm::dvec4 weight_slope;
        for (std::size_t axis = 0; axis < 4; ++axis) {
            const bool far = side[axis] != 0;
            weight[axis] = far ? quintic(t[axis]) : 1 - quintic(t[axis]);
            weight_slope[axis] = far ? fade_slope(t[axis]) : -fade_slope(t[axis]);
        }
        const double product = weight.x * weight.y * weight.z * weight.w;
        result.value += ramp * product;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            double others = 1;
            for (std::size_t other = 0; other < 4; ++other) {
                if (other != axis) others *= weight[other];
            }
            result.slope[axis] += gradient[axis] * product + ramp * others * weight_slope[axis];
        }
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
    std::uint32_t shift = 0;
    if (loops) {
        const double paths = *loops * ((time_period + 1) / 2);
        shift = static_cast<std::uint32_t>((paths - std::floor(paths)) * kPathSteps);
    }
    return cell_point(row_key(key, wrap(y, 1), wrap(z, 2)), wrap(x, 0), shift);
}

Dual improved_noise(const Lattice& lattice, const glm::dvec3& place) {
    return lattice.loops ? improved_noise_4(lattice, place) : improved_noise_3(lattice, place);
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
