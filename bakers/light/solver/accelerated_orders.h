// The sum of all orders of scattering, x = b + K b + K^2 b ...
//
// Order by order while a few suffice; beyond (dense air, where each order is nearly as bright as
// the one before) x = b + K x is solved by generalised minimal residuals (Saad & Schultz 1986),
// each channel on its own.
//
// What is left out is estimated from the ratio q of successive orders: after plain orders by the
// tail of a geometric series of the largest ratio at any point, which bounds it as K is positive;
// of a residual b + K x - x that is nowhere above r x by r / (1 - q).
#pragma once

#include <functional>

#include "bakers/light/solver/solved_light.h"
#include "bakers/math/bake_options.h"

namespace skybake {

struct OrderSum {
    LightField light;
    int applications = 0;  // of K
    double left_out = 0;  // estimate, as a share of the light at any point; of light that is darker
                          // than 1e-12 of the brightest, of that
};

// K: the light of the next order.
using NextOrder = std::function<void(const LightField& light, LightField& next)>;

struct SumSettings {
    double slowest_ratio = 0;  // below 1: upper limit of the ratio of two orders in the long run
    double tolerance = 0;      // of what is left out
    int plain_orders = 0;      // that are summed one by one
    int most_applications = 0;
};

// Until what is left out is below the tolerance, or the applications are used up.
OrderSum sum_of_orders(const LightField& first, const NextOrder& next, const SumSettings& settings,
                       Progress* progress);

// The first `orders` of them, at least one, and nothing of the rest.
OrderSum sum_of_first_orders(const LightField& first, const NextOrder& next, int orders,
                             Progress* progress);

}  // namespace skybake
