// What sky_radiance.h and its fast rows (sky_row.h) cut a ray's air into, and integrate by.
#pragma once

#include <algorithm>
#include <optional>

#include "bakers/math/gauss_legendre.h"
#include "bakers/math/vectors.h"

namespace skybake::ray_pieces {

inline constexpr double kLargestDepth = 1;  // of a piece, along the ray
// Light that has passed this optical depth adds e^-25 = 1e-11 to a picture.
inline constexpr double kLastLight = 25;
// Halvings of a piece: 2^-20 of a ray is metres.
inline constexpr int kMostHalvings = 20;

// The greatest depth of a piece, from the depths of its ends, over the channels whose light still
// reaches it; none where no light does.
inline std::optional<double> lit_depth(const Spectrum& from, const Spectrum& to, int channels) {
    std::optional<double> depth;
    for (int c = 0; c < channels; ++c) {
        if (data(from)[c] > kLastLight) continue;
        depth = std::max(depth.value_or(0), data(to)[c] - data(from)[c]);
    }
    return depth;
}

// Gauss' five nodes in each piece.
inline const QuadratureRule& gauss_rule() {
    static const QuadratureRule rule = gauss_legendre(5);
    return rule;
}

}  // namespace skybake::ray_pieces
