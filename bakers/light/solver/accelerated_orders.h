// The sum of all orders of scattering, x = b + K b + K^2 b ...
//
// The orders are summed one by one while a few suffice. Beyond that (in dense air, where each order
// is nearly as bright as the one before) x = b + K x is solved by the generalised minimal residual
// method (Saad & Schultz 1986), for each channel separately.
//
// The truncation error is estimated from the ratio q of successive orders. After plain orders it is
// the tail of a geometric series with the largest ratio at any point, which is an upper bound since
// K is positive. For a residual b + K x - x that is nowhere above r x it is r / (1 - q).
#pragma once

#include <functional>

#include "bakers/light/solver/solved_light.h"
#include "bakers/math/bake_options.h"

namespace skybake {

struct OrderSum {
    LightField light;
    int applications = 0;  // of K
    // Truncation error, as an estimated share of the light at any point; where that light is below
    // 1e-12 of the brightest, as a share of 1e-12 of the brightest.
    double left_out = 0;
};

// Applies K: computes the light of the next order.
using NextOrder = std::function<void(const LightField& light, LightField& next)>;

struct SumSettings {
    double slowest_ratio = 0;  // below 1: upper limit of the ratio of two orders in the long run
    double tolerance = 0;      // for the truncation error
    int plain_orders = 0;      // number of orders that are summed one by one
    int most_applications = 0;
};

// Sums orders until the truncation error is below the tolerance or the applications are used up.
OrderSum sum_of_orders(const LightField& first, const NextOrder& next, const SumSettings& settings,
                       Progress* progress);

// Sums the first `orders` of them, at least one, and nothing of the rest.
OrderSum sum_of_first_orders(const LightField& first, const NextOrder& next, int orders,
                             Progress* progress);

}  // namespace skybake
