// Where a view ray is in the planet's shadow.
#pragma once

#include "bakers/assets/bruneton/scattering_mapping.h"

namespace skybake {

// Distances along the ray; none where begin is not below end. The shadow, half a cylinder, is
// convex.
struct DarkStretch {
    double begin_km = 0;
    double end_km = 0;
};

// In terms of three cosines that need not belong to directions: between sun and zenith where the
// ray begins, and between sun and ray.
DarkStretch dark_stretch(const Shell& shell, const ScatteringView& view, double sun_cos_zenith,
                         double nu);

}  // namespace skybake
