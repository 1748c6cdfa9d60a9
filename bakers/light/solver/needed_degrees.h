// The degree of moments that light needs at an altitude: that of the phase functions which scatter it
// there. Air alone scatters by moments of degree 2, haze by some ten more, and fog by as many as a sky is
// solved for, except deep within it, where light comes from all sides.
#pragma once

#include <vector>

#include "bakers/air/medium.h"

namespace skybake {

inline constexpr int kDegreeOfAir = 3;
inline constexpr int kDegreeOfHaze = 8;

// Returns for each of the ascending altitudes the least of kDegreeOfAir, kDegreeOfHaze and `degree` that
// scatters all but kNegligibleLight of the light, if all layers were as dense throughout as they are there
// or at a neighbour. None is above `degree`.
std::vector<int> needed_degrees(const SkyMedium& medium, const std::vector<double>& altitudes_km,
                                int degree);

}  // namespace skybake
