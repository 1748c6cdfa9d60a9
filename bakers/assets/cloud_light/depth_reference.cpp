#include "bakers/assets/cloud_light/depth_reference.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>

#include "bakers/math/quadrature.h"

namespace skybake::cloud_light {
namespace {

// The distance from `at` to the next plane through voxel centres of one axis.
double to_next_plane(double at, double along) {
    if (along == 0) return std::numeric_limits<double>::infinity();
    const double centers = at - 0.5;
    const double next = along > 0 ? std::floor(centers) + 1 : std::ceil(centers) - 1;
    return (next - centers) / along;
}

double piece(const CloudLayer& layer, const glm::dvec3& place, const glm::dvec3& along, double a,
             double b) {
    const auto at = [&](double t) { return extinction_at(layer, place + along * t); };
    if (layer.optics.has_edge) {
        return adaptive_integral<std::array<double, 1>>([&](double t) { return std::array{at(t)}; },
                                                        a, b, 1e-6, 1e-9, 16)[0];
    }
    static const QuadratureRule rule = gauss_legendre(3);
    double sum = 0;
    for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
        sum += rule.weights[i] * at(a + (b - a) * rule.nodes[i]);
    }
    return sum * (b - a);
}

}  // namespace

double optical_depth_reference(const CloudLayer& layer, const glm::dvec3& place,
                               const glm::dvec3& direction) {
    assert(direction.z > 0);
    const glm::dvec3 along = in_voxels(layer, direction);
    const double end = ray_length(layer, place, along);
    double sum = 0;
    double t = 0;
    while (t < end) {
        const glm::dvec3 at = place + along * t;
        double step = end - t;
        for (std::size_t a = 0; a < 3; ++a) step = std::min(step, to_next_plane(at[a], along[a]));
        // A plane that rounding has left just ahead adds a piece of no length.
        step = std::max(step, 1e-9 * (1 + end));
        sum += piece(layer, place, along, t, std::min(t + step, end));
        t += step;
    }
    return sum;
}

}  // namespace skybake::cloud_light
