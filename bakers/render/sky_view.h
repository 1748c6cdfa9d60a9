// Renders pictures of the sky as a runtime does: single scattering by marching each pixel's ray,
// sunlight and multiple scattering from the two baked tables.
//
//   L = sum over segments of T (1 - e^(-sigma_t dt)) / sigma_t
//           [ sum over layers of sigma_s p(nu) T_sun + sigma_s Psi ]
//
// in 1/sr for a solar irradiance of 1. Where the table holds moments, the sum of
// solved_scattering_table.h over them takes the place of Psi. Densities are taken at the middle of each segment, and the
// integral over the segment is exact for them (Hillaire 2020, "A Scalable and Production Ready Sky
// and Atmosphere Rendering Technique", section 5.2). The sun is a point. If the planet hides it,
// T_sun is 0; this is tested before the lookup.
//
// The ground is Lambertian: its radiance is albedo (E_sun + E_sky) / pi with E_sun = mu_s T_sun and
// E_sky from the table of multiple scattering. That table's Psi is the mean radiance over all
// directions. At the ground, half of the directions are sky, with the mean J_sky, and half are
// ground, with albedo (E_sun / pi + J_sky) if the sky is taken as uniformly bright. Therefore
// J_sky = (2 Psi - albedo E_sun / pi) / (1 + albedo) = E_sky / pi.
//
// Hard cases: the sun on the horizon and below (rays that graze the shadow), the zenith and the
// sun itself as a direction, the camera on the ground (every ray below the horizontal has length 0)
// and at the top (rays upwards have length 0: black), a horizon 40 degrees down, 50 times the air,
// no air at all, one channel, albedo 0 and 1.
#pragma once

#include <span>
#include <vector>

#include "bakers/air/medium.h"
#include "bakers/field/image.h"
#include "bakers/render/sky_rays.h"
#include "bakers/render/sky_tables.h"

namespace skybake {

// The number of segments per ray. Their ends are at t = t0 + y |y| with evenly spaced y, where t0
// is the distance of the ray's densest point (its start, its lowest point or where it meets the
// ground). So steps are short where the air is dense. For rays upwards, t = length (i / n)^2.
inline constexpr int kSkySteps = 40;

// Returns the radiance in the tables' channels, with row 0 at the top and 0 outside of a dome. Each
// ray has `steps` segments. The bits are the same for any number of threads and any vector width.
Image2<float> render_sky(const SkyMedium& medium, const SkyTables& tables, const SkyView& view,
                         int threads, int steps = kSkySteps);

// Returns the radiance along rays of any cameras and suns, in as many segments; with `reaches_km`, that
// of the air up to a distance along each, as the published `skybake_air` has it.
std::vector<Spectrum> march_sky(const SkyMedium& medium, const SkyTables& tables,
                                const std::vector<SkyRay>& rays, int steps, int threads,
                                std::span<const double> reaches_km = {});

}  // namespace skybake
