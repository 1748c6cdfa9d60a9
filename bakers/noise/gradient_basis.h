// Gradient noise along one axis as a sum of four products.
//
// With u the position in a cell, w = 6u^5 - 15u^4 + 10u^3 and v = u - 1, improved noise is
//
//   sum over the corners k of a cell of  (gx u_k + gy v_k + gz t_k) W(x) W(y) W(z),
//
// so along each axis it is made of (1-w, w), weights, and (u (1-w), v w), distances times weights.
// Its derivative along an axis is the same sum with the derivatives of that axis' four functions.
// They are computed in double from an exact fraction and rounded once.
#pragma once

#include "bakers/noise/tile_axis.h"

namespace skybake::noise {

struct GradientBasis {
    float weight_0 = 0;    // 1 - w
    float weight_1 = 0;    // w
    float distance_0 = 0;  // u (1 - w)
    float distance_1 = 0;  // (u - 1) w
};

GradientBasis gradient_basis(const LatticePosition& position);

// Each times a factor, rounded to float.
inline GradientBasis scaled(const GradientBasis& basis, float factor) {
    return {basis.weight_0 * factor, basis.weight_1 * factor, basis.distance_0 * factor,
            basis.distance_1 * factor};
}

// d/du of each.
GradientBasis gradient_basis_derivative(const LatticePosition& position);

}  // namespace skybake::noise
