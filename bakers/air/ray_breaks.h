// Where a quadrature along a ray must be split.
#pragma once

#include <vector>

#include "bakers/air/medium.h"
#include "bakers/air/ray.h"

namespace skybake {

// Altitudes in the shell, ascending, between which each density is smooth and changes by a bounded
// factor: the ground, the top, the kinks of piecewise layers, and for each exponential layer the
// altitudes at the given numbers of scale heights.
std::vector<double> break_altitudes_km(const Medium& medium,
                                       const std::vector<double>& scale_heights);

struct RayBreak {
    double distance_km = 0;
    int level = -1;  // index of the break altitude that the ray crosses here, or -1
};

// From 0 to `length_km` with both ends, ascending: where the ray crosses those altitudes, and its
// lowest point.
std::vector<RayBreak> ray_breaks(const Shell& shell, double altitude_km, double s_km,
                                 double length_km, const std::vector<double>& altitudes_km);

}  // namespace skybake
