#include "bakers/assets/bruneton/planet_shadow.h"

#include <algorithm>
#include <cmath>

namespace skybake {

// The sun's ray through P grazes the ground where |P|^2 - (P . sun)^2 = R^2; along the view ray
// that is a x^2 + 2 b x + c = 0. Between the roots P is within the cylinder, on the night's side
// where P . sun < 0; as the ray is above the ground, that part of it is on one side only.
DarkStretch dark_stretch(const Shell& shell, const ScatteringView& view, double sun_cos_zenith,
                         double nu) {
    const double h = view.altitude_km;
    const double sun_s = (shell.ground_radius_km + h) * sun_cos_zenith;
    const double a = (1 - nu) * (1 + nu);
    const double b = view.s_km - sun_s * nu;
    const double c = h * (2 * shell.ground_radius_km + h) - sun_s * sun_s;
    const double discriminant = b * b - a * c;
    if (!(discriminant > 0)) return {};
    const double q = -(b + std::copysign(std::sqrt(discriminant), b));
    // A ray along the sun's has a root at infinity.
    const double first = c / q;
    const double second = a > 0 ? q / a : std::copysign(HUGE_VAL, q);
    const double begin = std::max(std::min(first, second), 0.0);
    const double end = std::min(std::max(first, second), view.length_km);
    if (!(begin < end) || 2 * sun_s + nu * (begin + end) >= 0) return {};
    return {begin, end};
}

}  // namespace skybake
