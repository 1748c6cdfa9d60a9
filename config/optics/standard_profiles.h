// How the gases of the Earth's air are spread over altitude: number densities, relative to the
// greatest of the source, linear between the points. They are 0 at and above the last point.
//
// Each profile has as few points as hold it within 1 % (air from 45 km up: 3 %) plus a part of the
// greatest density: 2e-7 for air (31 points, to 100 km), 0.3 % for ozone (25, to 68 km), 0.2 % for
// water vapour (10, to 20 km), 0.5 % for nitrogen dioxide (13, to 50 km). Each point is a kink to
// solvers, so that air and ozone have theirs at the same altitudes. The points do not lie on the curves but where the broken line stays within those bounds:
// ozone at 0 m is 2 % too much. In the last piece of each, where the line goes down to 0, only twice the
// bounds are held, if at all. Columns are exact, since those of layers are divided by that of the line.
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

// Returns the points by ascending altitude, the first at 0 m. Oxygen, nitrogen and carbon
// dioxide are spread as air.
std::span<const ProfilePoint> standard_profile(Gas gas);

// Returns the profile at an altitude >= 0.
double profile_at(std::span<const ProfilePoint> profile, double altitude_m);

}  // namespace skybake::config
