// The sum of all orders of scattering, x = b + K b + K^2 b ...
//
// It solves x = b + K x by the generalised minimal residual method (residual_search.h), whose
// directions are corrected by all orders on a coarse grid (coarse_orders.h). Earth's light takes
// three applications of K, and dense_earth's, with a zenith optical depth of 13, thirteen: order by
// order it would be a dozen and several hundred.
//
// The coarse grid's sum of a residual tells the truncation error. It is added at the end, so that
// the error that is left is smaller than what is said.
#pragma once

#include "bakers/light/solver/residual_search.h"
#include "bakers/light/solver/solved_light.h"
#include "bakers/math/bake_options.h"

namespace skybake {

struct OrderSum {
    LightField light;
    LightField residual;   // first + K light - light, where it is known
    int applications = 0;  // of K
    // Truncation error, as an estimated share of the light at any point (light_scale).
    double left_out = 0;
};

struct SumSettings {
    double tolerance = 0;  // for the truncation error in the mean; ten times as much anywhere
    int most_applications = 0;
};

// Sums orders until the truncation error is within the tolerance or the applications are used up.
// `sum` is an estimate with its residual.
OrderSum sum_of_orders(const LightField& first, OrderSum sum, const NextOrder& next,
                       const CorrectResidual& correct, const SumSettings& settings,
                       Progress* progress);

// Sums the first `orders` of them, at least one, and nothing of the rest.
OrderSum sum_of_first_orders(const LightField& first, const NextOrder& next, int orders,
                             Progress* progress);

}  // namespace skybake
