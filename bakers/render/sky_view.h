// Pictures of the sky as a runtime makes them: single scattering by marching each pixel's ray, the
// sun's light and all further scattering from the two baked tables.
//
//   L = sum over segments of T (1 - e^(-sigma_t dt)) / sigma_t
//           [ sum over layers of sigma_s p(nu) T_sun + sigma_s Psi ]
//
// in 1/sr for a solar irradiance of 1,
// with densities at the middle of each segment and the integral over it exact for them (Hillaire
// 2020, "A Scalable and Production Ready Sky and Atmosphere Rendering Technique", section 5.2). The
// sun is a point; where the planet hides it T_sun is 0, tested before the lookup.
//
// The ground is Lambert's: albedo (E_sun + E_sky) / pi with E_sun = mu_s T_sun, and E_sky from the
// table of multiple scattering. That table's Psi is the mean radiance J over all directions, at the
// ground half sky (J_sky) and half ground (albedo (E_sun / pi + J_sky), the sky taken as equally
// bright all over), so that J_sky = (2 Psi - albedo E_sun / pi) / (1 + albedo) = E_sky / pi.
//
// Hard cases: the sun on the horizon and below (rays that graze the shadow), the zenith and the
// sun itself as a direction, the camera on the ground (every ray below the horizontal has length 0)
// and at the top (rays upwards have length 0: black), a horizon 40 degrees down, 50 times the air,
// no air at all, one channel, albedo 0 and 1.
#pragma once

#include "bakers/air/medium.h"
#include "bakers/field/image.h"
#include "bakers/render/sky_rays.h"
#include "bakers/render/sky_tables.h"

namespace skybake {

// Segments per ray, and how they are spaced: with t0 the distance of the ray's densest point (its
// start, its lowest point or where it meets the ground), t = t0 + y |y|, y evenly spaced: short
// steps where the air is dense, from the camera on for rays upwards t = length (i / n)^2.
inline constexpr int kSkySteps = 40;

// Radiance of the tables' channels, row 0 at the top; outside of a dome 0. `steps` segments per
// ray. The same bits for any number of threads and any vector width.
Image2<float> render_sky(const SkyMedium& medium, const SkyTables& tables, const SkyView& view,
                         int threads, int steps = kSkySteps);

// The same without vectors: its specification.
Image2<float> render_sky_scalar(const SkyMedium& medium, const SkyTables& tables,
                                const SkyView& view, int threads);

// Adds the sun's disc, of uniform brightness, 0.53 degrees wide, dimmed by the air as the table
// says and cut by the horizon.
void add_sun_disc(const SkyMedium& medium, const SkyTables& tables, const SkyView& view,
                  Image2<float>& radiance);

}  // namespace skybake
