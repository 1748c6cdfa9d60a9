// The suns of a solution: cosines of zenith angles, densest about the terminator.
//
//   u(mu_s) = a + b mu_s + c x / sqrt(1 + x^2),   x = (mu_s - centre) / width
//
// u counts columns. Half of them are evenly spaced in mu_s (b), half about `centre`, where the air
// half way up loses the sun; width is a share of the sine of the dip of the shell's top, so that
// small planets with high air get what they need. The axis ends where the night holds less than
// rounding of the day, at some dips below the horizon; darker suns are taken for that one. Its ends
// are at u = -1/2 and count - 1/2, so that no column has a sun without an azimuth.
#pragma once

#include <vector>

#include "bakers/air/ray.h"

namespace skybake {

struct SunAxis {
    double darkest = -1;  // the lowest cosine
    double centre = 0;
    double width = 0;
    double offset = 0;            // a
    double even = 0;              // b
    double dense = 0;             // c
    std::vector<double> cosines;  // of the columns, ascending

    int count() const { return static_cast<int>(cosines.size()); }
    // u of a cosine in [darkest, 1].
    double position(double sun_cos_zenith) const;
};

// `count` >= 8.
SunAxis make_sun_axis(const Shell& shell, int count);

// Lagrange's cubic through four neighbouring columns, the first of which is `column`.
struct SunStencil {
    int column = 0;
    double weights[4];
};

SunStencil sun_stencil(const SunAxis& axis, double sun_cos_zenith);

// Of the same four columns, linear between the two around the sun; beyond the axis' ends the
// nearest. No weight is negative.
SunStencil linear_stencil(const SunAxis& axis, double sun_cos_zenith, int column);

}  // namespace skybake
