// The place of a ray's transmittance in its table.
//
// The coordinates are those of Bruneton & Neyret 2008, section 4. With H = sqrt(R_top^2 - R^2),
// rho = sqrt(r^2 - R^2), d the distance to the top, d_min = R_top - r and d_max = rho + H,
//
//   x_mu = (d - d_min) / (d_max - d_min),   x_r = rho / H,   both in [0, 1].
//
// x_mu = 0 is straight up and 1 the horizon; x_r = 0 is the ground and 1 the top. Rays that hit the
// ground have no place in the table.
//
//   bruneton  x = 0 and 1 fall on the centres of the first and last texel: u = 1/2N + x (1 - 1/N)
//   ue        x = 0 and 1 fall on the edges of the texture: u = x, the convention of the sample in
//             "A Scalable and Production Ready Sky and Atmosphere Rendering Technique" (Hillaire
//             2020)
#pragma once

#include "bakers/air/ray.h"

namespace skybake {

struct TransmittanceRay {
    double altitude_km = 0;
    double s_km = 0;  // r mu
};

struct UnitCoordinates {
    double x_mu = 0;
    double x_r = 0;
};

// Returns the ray of coordinates in [0, 1]. At the top (x_r = 1) x_mu = 0 is the ray straight up.
TransmittanceRay transmittance_ray(const Shell& shell, UnitCoordinates x);

// Returns the coordinates of a ray. This is the inverse of transmittance_ray within 1e-12.
UnitCoordinates transmittance_coordinates(const Shell& shell, double altitude_km,
                                          double cos_zenith);

// Returns the nearest coordinates whose ray is at least kHorizonMargin away from the horizon.
UnitCoordinates off_the_horizon(const Shell& shell, UnitCoordinates x);

// Returns the cosine of a ray's zenith angle.
double cos_zenith_of(const Shell& shell, const TransmittanceRay& ray);

}  // namespace skybake
