// How the gases of the Earth's air are spread over altitude: number densities, relative to their
// greatest value, linear between the points. They are 0 above the last point, whose density is 0 too.
//
// Each profile has as few points as hold 1 %, since each of them is a kink to solvers; the points
// are not on the curve but where the piecewise linear profile fits it best.
#pragma once

#include <span>

#include "config/optics/gases.h"

namespace skybake::config {

// This is one point of a profile.
struct ProfilePoint {
    double altitude_m = 0;
    double relative_density = 0;  // in [0, 1]
    bool operator==(const ProfilePoint&) const = default;
};

// Returns the points by ascending altitude, the first at 0 m. Oxygen is spread as air.
std::span<const ProfilePoint> standard_profile(Gas gas);

// Returns the integral of the profile over altitude in metres: a column divided by it is the number
// density where the profile is 1.
double profile_depth_m(std::span<const ProfilePoint> profile);

// Returns the profile at an altitude >= 0.
double profile_at(std::span<const ProfilePoint> profile, double altitude_m);

}  // namespace skybake::config
