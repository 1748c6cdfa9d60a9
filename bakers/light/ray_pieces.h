// What sky_radiance.h and its fast rows (sky_row.h) cut a ray's air into, and integrate by.
#pragma once

#include "bakers/math/gauss_legendre.h"

namespace skybake::ray_pieces {

inline constexpr double kLargestDepth = 1;  // of a piece, along the ray
// Light that has passed this optical depth adds e^-25 = 1e-11 to a picture.
inline constexpr double kLastLight = 25;
// Halvings of a piece: 2^-20 of a ray is metres.
inline constexpr int kMostHalvings = 20;

// Gauss' five nodes in each piece.
inline const QuadratureRule& gauss_rule() {
    static const QuadratureRule rule = gauss_legendre(5);
    return rule;
}

}  // namespace skybake::ray_pieces
