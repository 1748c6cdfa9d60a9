// How the albedo of the ground varies in pictures: fields, woods and bare soil, as no map says where they are.
//
// The albedo at a place is its mean times 1 + m, where m is a sum of value noises of cells of 3 km down to
// 20 m. The mean of m over a wide area is 0. A noise whose cells are not wider than a pixel's footprint is left
// out, so that far ground has its mean albedo and does not flicker.
#pragma once

#include "bakers/math/vectors.h"

namespace skybake {

// Returns m at a place, x and y in metres, for a pixel that covers `footprint_m` of the ground.
double ground_mottle(double x_m, double y_m, double footprint_m);

// Returns m where a ray from `eye_m` of a pixel as wide as `pixel`, at distance 1, meets the ground; 0 where it
// meets none. x and y are in metres, z is the altitude.
double ground_mottle_along(const glm::dvec3& eye_m, const glm::dvec3& direction, double pixel);

// Returns 1 + m of each channel. White ground varies less than dark ground, so that none is whiter than white.
Spectrum mottled(const Spectrum& albedo, double mottle);

}  // namespace skybake
