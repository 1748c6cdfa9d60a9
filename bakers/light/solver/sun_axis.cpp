#include "bakers/light/solver/sun_axis.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "bakers/air/transmittance_field.h"
#include "bakers/math/transcendental.h"

namespace skybake {

namespace {

// Of the sine of the top's dip: about 6 degrees on Earth.
constexpr double kWidthShare = 0.57;
// Over flat planets light changes with the cosine itself, most where it is small.
constexpr double kWidthOfFlatPlanets = 0.1;
// Suns further below the horizon than this many dips of the shell's top: Earth's last is at 26
// degrees, where the zenith has 1e-12 of its noon.
constexpr double kDarkestDips = 2.6;

double bend(double x) { return x / std::sqrt(1 + x * x); }

// The cosine at a column by bisection: u rises with it.
double cosine_at(const SunAxis& axis, double column) {
    double low = axis.darkest;
    double high = 1;
    for (int i = 0; i < 60; ++i) {
        const double middle = 0.5 * (low + high);
        (axis.position(middle) < column ? low : high) = middle;
    }
    return 0.5 * (low + high);
}

}  // namespace

double SunAxis::position(double sun_cos_zenith) const {
    return offset + even * sun_cos_zenith + dense * bend((sun_cos_zenith - centre) / width);
}

SunAxis make_sun_axis(const Shell& shell, int count) {
    assert(count >= 8);
    const double top_radius = shell.ground_radius_km + shell.thickness_km;
    const double dip_sine = horizon_distance_km(shell, shell.thickness_km) / top_radius;
    const double night = kDarkestDips * arc_cosine(shell.ground_radius_km / top_radius);
    SunAxis axis;
    axis.darkest = night < 0.5 * std::numbers::pi
                       ? cosine_of_turns((night + 0.5 * std::numbers::pi) / (2 * std::numbers::pi))
                       : -1;
    axis.centre = -std::sqrt(0.5 * shell.thickness_km / top_radius);  // sine of half the dip
    axis.width = is_flat_planet(shell) ? kWidthOfFlatPlanets : kWidthShare * dip_sine;
    const double first = bend((axis.darkest - axis.centre) / axis.width);
    const double last = bend((1 - axis.centre) / axis.width);
    axis.even = 0.5 * count / (1 - axis.darkest);
    axis.dense = 0.5 * count / (last - first);
    axis.offset = -0.5 - axis.even * axis.darkest - axis.dense * first;
    for (int i = 0; i < count; ++i) axis.cosines.push_back(cosine_at(axis, i));
    return axis;
}

int columns_below_horizon(const SunAxis& axis) {
    const auto first_of_day =
        std::lower_bound(axis.cosines.begin(), axis.cosines.end(), 0.0);  // ascending
    return static_cast<int>(first_of_day - axis.cosines.begin()) / 8 * 8;
}

SunStencil sun_stencil(const SunAxis& axis, double sun_cos_zenith) {
    const double u = axis.position(std::max(sun_cos_zenith, axis.darkest));
    SunStencil stencil;
    stencil.column = std::clamp(static_cast<int>(std::floor(u)) - 1, 0, axis.count() - 4);
    const double t = u - stencil.column - 1;
    stencil.weights[0] = t * (t - 1) * (2 - t) * (1.0 / 6);
    stencil.weights[1] = (t + 1) * (t - 1) * (t - 2) * 0.5;
    stencil.weights[2] = (t + 1) * t * (2 - t) * 0.5;
    stencil.weights[3] = (t + 1) * t * (t - 1) * (1.0 / 6);
    return stencil;
}

SunStencil linear_stencil(const SunAxis& axis, double sun_cos_zenith, int column) {
    const double u =
        std::clamp(axis.position(std::max(sun_cos_zenith, axis.darkest)), 0.0, axis.count() - 1.0);
    const int at = std::min(static_cast<int>(u), axis.count() - 2);
    SunStencil stencil{column, {0, 0, 0, 0}};
    stencil.weights[at - column] = 1 - (u - at);
    stencil.weights[at - column + 1] = u - at;
    return stencil;
}

}  // namespace skybake
