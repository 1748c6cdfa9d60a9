#include "bakers/light/solver/sun_axis.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

#include "bakers/air/transmittance_field.h"
#include "bakers/math/transcendental.h"

namespace skybake {
namespace {

// The axis's width as a share of the sine of the top's dip: about 6 degrees on Earth.
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

// Lagrange's weights of four columns, at t in columns from the second of them.
void cubic_weights(double t, double* weights) {
    weights[0] = t * (t - 1) * (2 - t) * (1.0 / 6);
    weights[1] = (t + 1) * (t - 1) * (t - 2) * 0.5;
    weights[2] = (t + 1) * t * (2 - t) * 0.5;
    weights[3] = (t + 1) * t * (t - 1) * (1.0 / 6);
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
    const auto first_of_day = std::ranges::lower_bound(axis.cosines, 0.0);  // ascending
    return static_cast<int>(first_of_day - axis.cosines.begin()) / 8 * 8;
}

SunStencil sun_stencil(const SunAxis& axis, double sun_cos_zenith) {
    const double u = axis.position(std::max(sun_cos_zenith, axis.darkest));
    SunStencil stencil;
    stencil.column = std::clamp(static_cast<int>(std::floor(u)) - 1, 0, axis.count() - 4);
    cubic_weights(u - stencil.column - 1, stencil.weights);
    return stencil;
}

double fall_between(double darker, double brighter) {
    constexpr double kMost = 60;  // floats hold its exponential
    if (!(darker > 0 && brighter > darker)) return 0;
    const double rise = logarithm(brighter / darker);
    return rise < kMost ? -rise : 0;
}

void steep_weights(double place, const double* falls, double* weights) {
    const double x = std::clamp(place, 0.0, 3.0);
    const int low = std::min(static_cast<int>(x), 2);
    const double share = x - low;
    const double fall = falls[low];
    double cubic[4];
    cubic_weights(x - 1, cubic);
    // The difference of the logarithm's cubic from the line, by gaps instead of columns.
    double bend = 0;
    double sum = 0;
    for (int k = 0; k < 3; ++k) {
        sum += cubic[k] - (k == low ? 1 - share : k == low + 1 ? share : 0);
        bend += sum * std::max(falls[k], 2 * fall);
    }
    std::fill_n(weights, 4, 0.0);
    weights[low] = (1 - share) * exponential(bend - share * fall);
    weights[low + 1] = share * exponential(bend + (1 - share) * fall);
}

SunStencil steep_stencil(const SunAxis& axis, double sun_cos_zenith, int column,
                         const double* means) {
    SunStencil stencil;
    stencil.column = column;
    const double u = axis.position(std::max(sun_cos_zenith, axis.darkest));
    double falls[3];
    for (int k = 0; k < 3; ++k) falls[k] = fall_between(means[k], means[k + 1]);
    steep_weights(u - column, falls, stencil.weights);
    return stencil;
}

}  // namespace skybake
