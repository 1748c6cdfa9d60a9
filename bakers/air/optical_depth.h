// Optical depth of straight rays through a medium, in double precision, for one ray or for many,
// and a slow reference that the kernels are compared with. Formulas, error bounds and hard cases
// are in optical_depth-inl.h.
#pragma once

#include <span>

#include "bakers/air/medium.h"

namespace skybake {

// Computes the optical depth to the top of the atmosphere for `count` rays that start at one
// altitude in [0, thickness]. s_km[i] = r mu of ray i, which must not point below the horizon. The
// depth of ray i in channel c is written to optical_depth[c * count + i]. The relative error is
// about 1e-14, and below 2e-11 in air deeper than the planet is large. The bits are the same for
// any vector width.
void optical_depth_to_top(const Medium& medium, double altitude_km, const double* s_km, int count,
                          double* optical_depth);

// Computes the same for rays of which each has an altitude of its own.
void optical_depth_to_top(const Medium& medium, std::span<const double> altitudes_km,
                          std::span<const double> s_km, double* optical_depth);

// Returns the same for one ray, without vectors: the specification of the function above.
Spectrum optical_depth_to_top(const Medium& medium, double altitude_km, double s_km);

// Returns the optical depth of the first `distance_km` of the ray that starts at an altitude with
// cosine of the zenith angle `cos_zenith`. The path must stay within the shell. The relative error
// of the path's own depth is as above, however short the path is: the result is never a difference
// of two depths.
Spectrum optical_depth_along(const Medium& medium, double altitude_km, double cos_zenith,
                             double distance_km);

// Computes the same for several distances, in vectors: channel c of distance i is written to
// optical_depth[c * count + i].
void optical_depth_along(const Medium& medium, double altitude_km, double cos_zenith,
                         std::span<const double> distances_km, double* optical_depth);

// Computes the same for paths of which each has an altitude, s = r mu and a length of its own.
void optical_depth_along(const Medium& medium, std::span<const double> altitudes_km,
                         std::span<const double> s_km, std::span<const double> lengths_km,
                         double* optical_depth);

// --- Reference -----------------------------------------------------------------------------------

// Optical depth by adaptive quadrature of the definition: extinction integrated over distance. It
// shares only the medium with the kernel and is about a thousand times slower.

// Returns the optical depth of a ray from an altitude with s = r mu to the top. The ray must not
// hit the ground. Intervals are halved until two rules agree within `relative`.
Spectrum reference_optical_depth_to_top(const Medium& medium, double altitude_km, double s_km,
                                        double relative = 1e-12);

// Returns the optical depth of the first `distance_km` of that ray.
Spectrum reference_optical_depth_along(const Medium& medium, double altitude_km, double s_km,
                                       double distance_km, double relative = 1e-12);

}  // namespace skybake
