// Optical depth by adaptive quadrature of the definition, extinction over distance. It shares with
// the kernel only the medium; about a thousand times slower.
#pragma once

#include "bakers/air/medium.h"

namespace skybake {

// Along a ray from an altitude with s = r mu to the top; the ray must not hit the ground. The
// intervals are halved until two rules agree within `relative`.
Spectrum reference_optical_depth_to_top(const Medium& medium, double altitude_km, double s_km,
                                        double relative = 1e-12);

// Along the first `distance_km` of that ray.
Spectrum reference_optical_depth_along(const Medium& medium, double altitude_km, double s_km,
                                       double distance_km, double relative = 1e-12);

}  // namespace skybake
