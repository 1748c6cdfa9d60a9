#include "bakers/assets/phase/phase_axis.h"

#include <cmath>
#include <numbers>

#include "bakers/math/transcendental.h"
#include "config/assets/phase.h"

namespace skybake {

using config::PhaseSpacing;

namespace {

double fourth_root(double x) { return std::sqrt(std::sqrt(x)); }

}  // namespace

ScatteringAngle scattering_angle(PhaseSpacing spacing, double x) {
    if (spacing == PhaseSpacing::angle) {
        // 1 - cos theta = 2 sin^2(theta / 2).
        const double sine = cosine_of_pi(0.5 * std::fabs(1 - x));
        const double cosine = cosine_of_pi(0.5 * x);
        return {2 * sine * sine, 2 * cosine * cosine};
    }
    if (spacing == PhaseSpacing::cosine) return {2 * x, 2 * (1 - x)};
    const double w = x <= 0.5 ? 2 * x : 2 * (1 - x);
    const double from_pole = w * w * w * w;
    return x <= 0.5 ? ScatteringAngle{from_pole, 2 - from_pole}
                    : ScatteringAngle{2 - from_pole, from_pole};
}

double phase_coordinate(PhaseSpacing spacing, const ScatteringAngle& angle) {
    if (spacing == PhaseSpacing::angle) return radians(angle) / std::numbers::pi;
    if (spacing == PhaseSpacing::cosine) return 0.5 * angle.one_minus;
    return angle.one_minus <= angle.one_plus ? 0.5 * fourth_root(angle.one_minus)
                                             : 1 - 0.5 * fourth_root(angle.one_plus);
}

double radians(const ScatteringAngle& angle) {
    // From the nearer pole, twice the arc sine of half the chord; pi / 2 - acos of it loses digits
    // of small angles, the arc cosine of its complement does not.
    const bool forward = angle.one_minus <= angle.one_plus;
    const double near = forward ? angle.one_minus : angle.one_plus;
    const double half_sine = std::sqrt(0.5 * near);
    // asin x = x + x^3 / 6 + 3 x^5 / 40 ...: below 1e-3 the third term is below 1e-16.
    const double half = half_sine < 1e-3 ? half_sine * (1 + half_sine * half_sine / 6)
                                         : 0.5 * std::numbers::pi - arc_cosine(half_sine);
    return forward ? 2 * half : std::numbers::pi - 2 * half;
}

}  // namespace skybake
