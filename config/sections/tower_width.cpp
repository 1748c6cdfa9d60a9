#include "config/sections/tower_width.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace skybake::config {

double narrowest_sigma(const Tower& tower, const std::array<int, 3>& size) {
    const double c = std::cos(tower.rotation.radians);
    const double s = std::sin(tower.rotation.radians);
    const double a = tower.sigma[0] * tower.sigma[0];
    const double b = tower.sigma[1] * tower.sigma[1];
    const double ab = tower.correlation * tower.sigma[0] * tower.sigma[1];
    const double xx = (c * c * a - 2 * c * s * ab + s * s * b) * size[0] * size[0];
    const double yy = (s * s * a + 2 * c * s * ab + c * c * b) * size[1] * size[1];
    const double xy = (c * s * (a - b) + (c * c - s * s) * ab) * size[0] * size[1];
    if (size[0] == 1 && size[1] == 1) return std::numeric_limits<double>::infinity();
    if (size[0] == 1) return std::sqrt(yy);
    if (size[1] == 1) return std::sqrt(xx);
    const double half_sum = 0.5 * (xx + yy);
    const double lesser = half_sum - std::hypot(0.5 * (xx - yy), xy);
    return std::sqrt(std::max(0.0, lesser));  // rounding may take it below 0
}

double narrowest_sigma(const TowerScatter& scatter, const std::array<int, 3>& size) {
    double voxels = std::numeric_limits<double>::infinity();
    for (const std::size_t axis : {0u, 1u}) {
        if (size[axis] > 1) voxels = std::min(voxels, scatter.sigma[0] * size[axis]);
    }
    return voxels;
}

}  // namespace skybake::config
