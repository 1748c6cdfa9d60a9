// Which suns a table must hold for the cameras and suns of a scene.
#pragma once

#include "bakers/air/ray.h"
#include "config/sections/scene.h"

namespace skybake {

// Of the cosine of the sun's zenith angle.
struct SunRange {
    double lowest = -1;
    double highest = 1;
};

// Of all points in the air, its top and the ground included, that view rays from the scene's
// cameras pass under the scene's suns.
//
// From the planet's centre no point of such a ray is further from the camera than the one where the
// ray that grazes the ground leaves the air:
//
//   psi = arccos(R / (R + h)) + arccos(R / R_top)
//
// with h the highest camera's altitude, in the air or in space, and the sun's zenith angle at a
// point differs from that at the camera by no more than psi. Attained by cameras that look along
// the sun's azimuth.
SunRange scene_sun_range(const config::Scene& scene, const Shell& shell);

}  // namespace skybake
