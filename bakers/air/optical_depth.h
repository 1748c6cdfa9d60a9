// Optical depth of straight rays through a medium, in double precision, for one ray or for many.
// Formulas, error bounds and hard cases are in optical_depth-inl.h.
#pragma once

#include "bakers/air/medium.h"

namespace skybake {

// From a point to the top of the atmosphere, for `count` rays that start at one altitude in
// [0, thickness]; s_km[i] = r mu of each, not below the horizon. Channel c of ray i goes to
// optical_depth[c * count + i]. Relative error about 1e-14, below 2e-11 in air deeper than
// the planet is large. The same bits for any vector width.
void optical_depth_to_top(const Medium& medium, double altitude_km, const double* s_km, int count,
                          double* optical_depth);

// The same for one ray, without vectors: the specification of the above.
Spectrum optical_depth_to_top(const Medium& medium, double altitude_km, double s_km);

// Along `distance_km` of the ray that starts at an altitude with cosine of the zenith angle
// `cos_zenith`; the path must stay within the shell. Relative error as above of the path's own
// depth, however short it is: never a difference of two depths.
Spectrum optical_depth_along(const Medium& medium, double altitude_km, double cos_zenith,
                             double distance_km);

// --- Reference -----------------------------------------------------------------------------------

// Optical depth by adaptive quadrature of the definition, extinction over distance. It shares with
// the kernel only the medium; about a thousand times slower.

// Along a ray from an altitude with s = r mu to the top; the ray must not hit the ground. The
// intervals are halved until two rules agree within `relative`.
Spectrum reference_optical_depth_to_top(const Medium& medium, double altitude_km, double s_km,
                                        double relative = 1e-12);

// Along the first `distance_km` of that ray.
Spectrum reference_optical_depth_along(const Medium& medium, double altitude_km, double s_km,
                                       double distance_km, double relative = 1e-12);

}  // namespace skybake
