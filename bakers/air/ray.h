// Straight rays in a spherical shell, in formulas that hold at the ground, at the top, at the
// horizon and for any size of planet; also where quadratures along rays are split, and how near the
// horizon probes may look.
//
// A ray starts at an altitude h (r = R + h) and is given by s = r mu, where mu is the cosine of its
// zenith angle; after a distance x it is at s + x. Altitudes follow from r' - r = q / (r' + r) with
// q = x (x + 2 s), never from a difference of radii.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "bakers/air/medium.h"
#include "bakers/math/facts.h"
#include "bakers/math/transcendental.h"

namespace skybake {

// The shell between the ground and the top of the atmosphere.
struct Shell {
    double ground_radius_km = 0;
    double thickness_km = 0;
};

inline Shell shell_of(const Medium& medium) {
    return {medium.ground_radius_km, medium.thickness_km};
}

// Returns the distance from a point at altitude h to the horizon, rho = sqrt(r^2 - R^2). The
// horizon is at s = -rho.
inline double horizon_distance_km(const Shell& shell, double altitude_km) {
    return std::sqrt(altitude_km * (2 * shell.ground_radius_km + altitude_km));
}

// Returns r'^2 - r^2 in km^2, where r and r' are the distances to the planet's centre before and
// after a gain of altitude.
inline double square_gain_km2(const Shell& shell, double altitude_km, double gain_km) {
    return gain_km * (2 * (shell.ground_radius_km + altitude_km) + gain_km);
}

// Returns the gain of altitude r' - r over which r'^2 - r^2 = q, in km.
inline double gain_of_square_km(double r_km, double q) {
    return q / (std::sqrt(std::max(r_km * r_km + q, 0.0)) + r_km);
}

// Returns the altitude after `distance_km`, along a path within the shell.
inline double altitude_along_km(const Shell& shell, double altitude_km, double s_km,
                                double distance_km) {
    const double r = shell.ground_radius_km + altitude_km;
    const double q = distance_km * (distance_km + 2 * s_km);
    return altitude_km + gain_of_square_km(r, q);
}

// Returns the same; rounding does not lead out of the shell.
inline double altitude_in_shell_km(const Shell& shell, double altitude_km, double s_km,
                                   double distance_km) {
    return std::clamp(altitude_along_km(shell, altitude_km, s_km, distance_km), 0.0,
                      shell.thickness_km);
}

// Returns the distance to the last point of a ray that is `gain_km` >= 0 above its start.
inline double climb_distance_km(const Shell& shell, double altitude_km, double s_km,
                                double gain_km) {
    const double q = square_gain_km2(shell, altitude_km, gain_km);
    const double root = std::sqrt(s_km * s_km + q);
    return s_km > 0 ? q / (root + s_km) : root - s_km;
}

// Returns the distance to the top of the atmosphere.
inline double distance_to_top_km(const Shell& shell, double altitude_km, double s_km) {
    return climb_distance_km(shell, altitude_km, s_km, shell.thickness_km - altitude_km);
}

// Returns the distance to the ground, for s <= -rho.
inline double distance_to_ground_km(const Shell& shell, double altitude_km, double s_km) {
    const double q = altitude_km * (2 * shell.ground_radius_km + altitude_km);  // rho^2
    return q / (-s_km + std::sqrt(std::max(s_km * s_km - q, 0.0)));
}

// Returns how far below `altitude_km` the nearest point of a ray with s < 0 lies.
inline double drop_to_nearest_km(const Shell& shell, double altitude_km, double s_km) {
    const double r = shell.ground_radius_km + altitude_km;
    return s_km * s_km / (r + std::sqrt((r - s_km) * (r + s_km)));
}

// --- Breaks --------------------------------------------------------------------------------------

// The points at which a quadrature along a ray is split.

// Returns altitudes in the shell, ascending, between which each density is smooth and changes by a
// bounded factor: the ground, the top, the kinks of piecewise layers, and for each exponential
// layer the altitudes at the given multiples of its scale height.
std::vector<double> break_altitudes_km(const Medium& medium,
                                       const std::vector<double>& scale_heights);

struct RayBreak {
    double distance_km = 0;
    int level = -1;  // index of the break altitude that the ray crosses here, or -1
};

// Returns the points of a ray from 0 to `length_km`, ascending and including both ends, where it
// crosses those altitudes or has its lowest point.
std::vector<RayBreak> ray_breaks(const Shell& shell, double altitude_km, double s_km,
                                 double length_km, const std::vector<double>& altitudes_km);

// --- Near the horizon ----------------------------------------------------------------------------

// The smallest angle to the horizon at which a probe may look. Closer to the horizon rounding
// decides whether a runtime sees the ground.
inline constexpr double kHorizonMargin = 0.01 * std::numbers::pi / 180;  // radians

// Return s = r mu of the rays at this angle above the horizon and at the same angle below it. The
// horizon's dip below the horizontal has cos dip = R / r and sin dip = rho / r, so that
// s = r sin(+-angle - dip).
inline double lowest_s_of_sky_km(const Shell& shell, double altitude_km) {
    const SineCosine margin = sine_and_cosine(kHorizonMargin);
    return shell.ground_radius_km * margin.sine -
           horizon_distance_km(shell, altitude_km) * margin.cosine;
}
inline double highest_s_of_ground_km(const Shell& shell, double altitude_km) {
    const SineCosine margin = sine_and_cosine(kHorizonMargin);
    return -shell.ground_radius_km * margin.sine -
           horizon_distance_km(shell, altitude_km) * margin.cosine;
}

// --- Constants of mappings -----------------------------------------------------------------------

// The planet's dimensions among the constants of a mapping.

// Returns R_ground, R_top and R_top - R_ground of the formulas. The difference is stated separately
// because a difference of radii in float is off by metres.
inline Facts shell_constants(const Shell& shell) {
    return {{"ground_radius_km", shell.ground_radius_km},
            {"top_radius_km", shell.ground_radius_km + shell.thickness_km},
            {"thickness_km", shell.thickness_km}};
}

}  // namespace skybake
