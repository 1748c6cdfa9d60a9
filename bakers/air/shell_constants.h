// The planet's measures among the constants of a mapping.
#pragma once

#include "bakers/air/ray.h"
#include "bakers/math/facts.h"

namespace skybake {

// R_ground, R_top and R_top - R_ground of the formulas. The last stands by itself because in float
// a difference of radii is off by metres.
inline Facts shell_constants(const Shell& shell) {
    return {{"ground_radius_km", shell.ground_radius_km},
            {"top_radius_km", shell.ground_radius_km + shell.thickness_km},
            {"thickness_km", shell.thickness_km}};
}

}  // namespace skybake
