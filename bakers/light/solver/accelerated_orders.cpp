#include "bakers/light/solver/accelerated_orders.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cstddef>
#include <utility>

namespace skybake {

namespace {

// A night sky without a moon, as a share of the day's.
constexpr double kStarlight = 1e-8;
// How much larger than in the mean the error may be somewhere.
constexpr double kLargestOverMean = 10;

// The search resolves light down to kDarkest of the brightest; less than nothing there is rounding
// of brighter light elsewhere, and in truth nothing that could be told.
void drop_less_than_nothing(LightField& light) {
    const std::size_t size = light.sun_size();
    std::array<double, kChannelSlots> brightest{};
    for (std::size_t i = 0; i < light.moments.size(); i += size) {
        for (std::size_t c = 0; c < kChannelSlots; ++c) {
            brightest[c] = std::max(brightest[c], light.moments[i + c]);
        }
    }
    for (std::size_t i = 0; i < light.moments.size(); i += size) {
        for (std::size_t c = 0; c < kChannelSlots; ++c) {
            const double mean = light.moments[i + c];
            if (mean >= 0 || -mean > kStarlight * brightest[c]) continue;
            for (std::size_t k = i + c; k < i + size; k += kChannelSlots) light.moments[k] = 0;
        }
    }
    for (double& value : light.sky_irradiance) value = std::max(value, 0.0);
}

}  // namespace

OrderSum sum_of_orders(const LightField& first, OrderSum sum, const NextOrder& next,
                       const CorrectResidual& correct, const SumSettings& settings,
                       Progress* progress) {
    while (!is_cancelled(progress)) {
        const LightScale scale = light_scale(sum.light);
        const ResidualSearch search = {settings.tolerance,
                                       settings.most_applications - sum.applications};
        sum.applications +=
            search_residual(next, correct, scale, search, progress, sum.residual, sum.light);
        const LightField missing = correct(sum.residual, scale);
        add(missing, sum.light);
        const LightScale found = light_scale(sum.light);
        sum.left_out = largest_share(missing, found);
        const bool is_small = mean_share(missing, found) <= settings.tolerance &&
                              sum.left_out <= kLargestOverMean * settings.tolerance;
        if (is_small || sum.applications >= settings.most_applications) break;
        sum.residual = residual_of(first, next, sum.light);
        ++sum.applications;
    }
    drop_less_than_nothing(sum.light);
    return sum;
}

OrderSum sum_of_first_orders(const LightField& first, const NextOrder& next, int orders,
                             Progress* progress) {
    assert(orders >= 1);
    OrderSum sum;
    sum.light = first;
    LightField before = first;
    LightField added(first.levels, first.suns, first.degree);
    for (int order = 2; order <= orders && !is_cancelled(progress); ++order) {
        next(before, added);
        ++sum.applications;
        add(added, sum.light);
        std::swap(before, added);
    }
    drop_less_than_nothing(sum.light);
    return sum;
}

}  // namespace skybake
