// The suns of a solution: cosines of zenith angles, densest about the terminator.
//
//   u(mu_s) = a + b mu_s + c x / sqrt(1 + x^2),   x = (mu_s - centre) / width
//
// u counts columns. Half of the columns are evenly spaced in mu_s (b), the other half is
// concentrated about `centre` (c), where the air half way up loses the sun. The width is a share of
// the sine of the dip of the shell's top, so that small planets with high air get the columns they
// need. The axis ends a few dips below the horizon, where the light of the night is less than the
// rounding of the day's; darker suns are treated as the darkest one. The axis's ends are at u =
// -1/2 and count - 1/2, so that no column's sun lies at the zenith or nadir, where it has no
// azimuth.
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
    // Returns u of a cosine in [darkest, 1].
    double position(double sun_cos_zenith) const;
};

// Makes an axis of `count` >= 8 columns.
SunAxis make_sun_axis(const Shell& shell, int count);

// Returns how many of the first columns have suns below the horizon, rounded down to a multiple of
// 8: whole vectors of columns, whatever the vectors' width.
int columns_below_horizon(const SunAxis& axis);

// The weights of Lagrange's cubic through four neighbouring columns, the first of which is
// `column`.
struct SunStencil {
    int column = 0;
    double weights[4];
};

SunStencil sun_stencil(const SunAxis& axis, double sun_cos_zenith);

// Returns the logarithm of the mean light under a darker sun over that under a brighter one, and 0
// where it does not fall, or to nothing.
double fall_between(double darker, double brighter);

// Computes weights of four columns for light that falls too fast for cubics, at `place` in columns
// from the first of them; beyond the ends the nearest column counts. The light's share of a mean is
// linear between the two columns around, and the mean is a cubic in its logarithm. `falls` are those
// between the means of the four columns (fall_between); where there are none, light is linear. No
// weight is negative.
//
// Falls of the outer gaps count up to twice that of the gap around the place: a cubic bends no more.
void steep_weights(double place, const double* falls, double* weights);

// Returns them for a sun, of the four columns from `column` on, whose means are known.
SunStencil steep_stencil(const SunAxis& axis, double sun_cos_zenith, int column,
                         const double* means);

}  // namespace skybake
