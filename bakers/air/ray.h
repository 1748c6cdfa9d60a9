// Straight rays in a spherical shell, in forms that hold at the ground, at the top, at the horizon
// and for any size of planet.
//
// A ray starts at an altitude h (r = R + h) and is told by s = r mu, mu the cosine of its zenith
// angle: after a distance x it is at s + x. Altitudes come from r' - r = q / (r' + r), q = x (x + 2
// s), never from a difference of radii.
#pragma once

#include <algorithm>
#include <cmath>

#include "bakers/air/medium.h"

namespace skybake {

// The shell between the ground and the top of the atmosphere.
struct Shell {
    double ground_radius_km = 0;
    double thickness_km = 0;
};

inline Shell shell_of(const Medium& medium) {
    return {medium.ground_radius_km, medium.thickness_km};
}

// Distance from a point at altitude h to the horizon:
// rho = sqrt(r^2 - R^2). The horizon is at s = -rho.
inline double horizon_distance_km(const Shell& shell, double altitude_km) {
    return std::sqrt(altitude_km * (2 * shell.ground_radius_km + altitude_km));
}

// By how much the square of the distance to the planet's centre grows over a gain of altitude:
// r'^2 - r^2, in km^2.
inline double square_gain_km2(const Shell& shell, double altitude_km, double gain_km) {
    return gain_km * (2 * (shell.ground_radius_km + altitude_km) + gain_km);
}

// The gain of altitude r' - r over which r'^2 - r^2 = q.
inline double gain_of_square_km(double r_km, double q) {
    return q / (std::sqrt(std::max(r_km * r_km + q, 0.0)) + r_km);
}

// Altitude after `distance_km`, along a path within the shell.
inline double altitude_along_km(const Shell& shell, double altitude_km, double s_km,
                                double distance_km) {
    const double r = shell.ground_radius_km + altitude_km;
    const double q = distance_km * (distance_km + 2 * s_km);
    return altitude_km + gain_of_square_km(r, q);
}

// Distance to where a ray climbs for good by `gain_km` >= 0.
inline double climb_distance_km(const Shell& shell, double altitude_km, double s_km,
                                double gain_km) {
    const double q = square_gain_km2(shell, altitude_km, gain_km);
    const double root = std::sqrt(s_km * s_km + q);
    return s_km > 0 ? q / (root + s_km) : root - s_km;
}

// Distance to the top of the atmosphere.
inline double distance_to_top_km(const Shell& shell, double altitude_km, double s_km) {
    return climb_distance_km(shell, altitude_km, s_km, shell.thickness_km - altitude_km);
}

// Distance to the ground for s < -rho (or at it).
inline double distance_to_ground_km(const Shell& shell, double altitude_km, double s_km) {
    const double q = altitude_km * (2 * shell.ground_radius_km + altitude_km);  // rho^2
    return q / (-s_km + std::sqrt(std::max(s_km * s_km - q, 0.0)));
}

// How far below `altitude_km` the nearest point of a ray with s < 0 lies.
inline double drop_to_nearest_km(const Shell& shell, double altitude_km, double s_km) {
    const double r = shell.ground_radius_km + altitude_km;
    return s_km * s_km / (r + std::sqrt((r - s_km) * (r + s_km)));
}

}  // namespace skybake
