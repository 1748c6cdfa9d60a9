// The suns of a solution: zenith angles from 0 to 180 degrees, densest about the terminator.
//
//   theta = theta_0 + scale sinh(v),   v evenly spaced
//
// theta_0 lies where the highest air loses the sun, half way between the horizon and the shell's
// dip; scale is a share of that dip, so that small planets with high air get what they need.
#pragma once

#include "bakers/atmosphere/ray.h"

namespace skybake {

struct SunAxis {
    int count = 0;
    double centre = 0;  // theta_0, radians
    double scale = 0;   // radians
    double first = 0;   // v of theta = 0
    double step = 0;    // of v

    double zenith_angle(int column) const;
    // Column, with its fraction, of an angle in [0, pi].
    double position(double zenith_angle) const;
};

SunAxis make_sun_axis(const Shell& shell, int count);

}  // namespace skybake
