#include "bakers/light/solver/solve_light.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cstddef>
#include <functional>
#include <utility>

#include "bakers/air/forward_peak.h"
#include "bakers/light/solver/coarse_orders.h"
#include "bakers/light/solver/first_light.h"
#include "bakers/light/solver/peaked_light.h"
#include "bakers/light/solver/reading_levels.h"
#include "bakers/light/solver/residual_search.h"
#include "bakers/light/solver/solution_levels.h"
#include "bakers/light/solver/transport.h"
#include "bakers/math/parallel.h"

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

// Light that falls faster than this from column to column is interpolated in its logarithm.
constexpr double kSteepest = 4;

// Where light of one of the channels falls too fast for cubics, at any level: a column's 1 stands
// for the stencil that begins there.
std::vector<double> steep_columns(const LightField& light, int channels) {
    std::vector<double> steep(static_cast<std::size_t>(light.suns));
    for (int level = 0; level < light.levels; ++level) {
        for (int sun = 0; sun + 3 < light.suns; ++sun) {
            for (std::size_t c = 0; c < static_cast<std::size_t>(channels); ++c) {
                for (int j = 0; j < 3; ++j) {
                    const double low = light.at(level, sun + j)[c];
                    const double high = light.at(level, sun + j + 1)[c];
                    if (!(std::max(low, high) < kSteepest * std::min(low, high))) {
                        steep[static_cast<std::size_t>(sun)] = 1;
                    }
                }
            }
        }
    }
    return steep;
}

constexpr int kLargestDegreeInFloats = 8;

// Each of so few orders is read by its own falls from sun to sun, for which no estimate is needed.
constexpr int kFewOrders = 3;

// Light between suns is read by the falls of an estimate. Where that is too dark, each order would make
// more light of it than there is, so the estimate takes further orders until none lifts it this much.
constexpr double kMostLift = 2;
constexpr int kMostLifts = 40;

// Returns how much brighter a residual makes the mean light anywhere, as a ratio.
double lift_by(const LightField& residual, LightField light) {
    const LightScale before = resolved_light(light);
    add(residual, light);
    const LightScale after = resolved_light(light);
    double most = 0;
    for (std::size_t i = 0; i < before.size(); ++i) {
        if (before[i] > 0) most = std::max(most, after[i] / before[i]);
    }
    return most;
}

struct OrderSum {
    LightField light;
    LightField residual;   // first + K light - light, where it is known
    int applications = 0;  // of K
    // Truncation error, as an estimated share of the light at any point (light_scale).
    double left_out = 0;
};

// Returns an estimate of the sum of all orders whose falls `next` may read light by, with its residual.
// `follow` makes it read by those of an estimate.
OrderSum estimated_sum(const LightField& first, LightField start, const NextOrder& next,
                       const std::function<void(const LightField& estimate)>& follow,
                       Progress* progress) {
    OrderSum sum;
    sum.light = std::move(start);
    while (!is_cancelled(progress)) {
        follow(sum.light);
        sum.residual = residual_of(first, next, sum.light);
        ++sum.applications;
        if (sum.applications == kMostLifts || lift_by(sum.residual, sum.light) < kMostLift) break;
        add(sum.residual, sum.light);
    }
    return sum;
}

// Sums orders until the truncation error is within the tolerance or the applications are used up.
// `sum` is an estimate with its residual.
OrderSum sum_of_orders(const LightField& first, OrderSum sum, const NextOrder& next,
                       const CorrectResidual& correct, const SolverSettings& settings,
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

// Sums the first `orders` of them, at least one, and nothing of the rest.
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

// Moments of a low degree depend on those of a higher one, up to so many times it.
constexpr int kFinerDegree = 4;

// Solves for moments of settings.degree in the medium as it is, with transport in floats or doubles
// (order_blocks.h).
template <class Number>
SolvedLight solve_orders_in(const SkyMedium& medium, const SolverSettings& settings, int threads,
                            Progress* progress) {
    SolvedLight solved;
    solved.channels = medium.air.channels;
    solved.altitudes_km = solution_levels_km(medium.air, settings.level_scale);
    solved.suns = make_sun_axis(shell_of(medium.air), settings.suns);
    const int levels = static_cast<int>(solved.altitudes_km.size());
    const TransmittanceField sunlight =
        tabulated_sunlight(medium.air, solved.altitudes_km, settings.sunlight, threads);

    const ReadingLevels reading(medium.air, solved.altitudes_km);
    LightField first(levels, settings.suns, settings.degree);
    const std::vector<SplitPhase> phases = split_phases(medium, settings.degree);
    const LayerMoments moments(medium, settings.degree, reading.altitudes_km());
    std::vector<LevelTransport<Number>> transports(static_cast<std::size_t>(levels));
    parallel_for(levels, threads, [&](int level) {
        FirstFans first_fans =
            make_first_fans(medium, reading.altitudes_km(), reading.index_of(level),
                            settings.first_zenith_nodes, settings.ray_tolerance);
        first_fans.azimuths = settings.first_azimuths;
        gather_first_light(medium, phases, first_fans, sunlight, solved.suns, settings.degree,
                           first.at(level, 0), level == 0 ? first.sky_irradiance.data() : nullptr);
        const bool is_same = settings.zenith_nodes == settings.first_zenith_nodes;
        transports[static_cast<std::size_t>(level)] = make_level_transport<Number>(
            medium,
            is_same ? first_fans.day
                    : make_ray_fan(medium, reading.altitudes_km(), reading.index_of(level),
                                   settings.zenith_nodes, settings.ray_tolerance),
            moments);
    });
    SteepSuns steep(steep_columns(first, solved.channels));
    solved.steep = steep.stencils;
    const auto next = [&](const LightField& light, LightField& image) {
        apply_transports(transports, solved.suns, steep, reading.blocks_of<Number>(light, threads),
                         threads, image);
    };
    const auto solved_by = [&](OrderSum sum) {
        solved.light = std::move(sum.light);
        solved.applications = sum.applications;
        solved.left_out = sum.left_out;
        return std::move(solved);
    };
    if (settings.orders > 0 && settings.orders <= kFewOrders) {
        const auto by_own_falls = [&](const LightField& light, LightField& image) {
            steep.follow(reading.read_light(light));
            next(light, image);
        };
        return solved_by(sum_of_first_orders(first, by_own_falls, settings.orders, progress));
    }
    CoarseOrders coarse(medium, solved, settings.zenith_nodes, settings.ray_tolerance, threads);
    const auto correct = [&](const LightField& residual, const LightScale& scale) {
        return coarse.sum_from(residual, scale, progress);
    };
    const auto follow = [&](const LightField& estimate) {
        coarse.follow(estimate);
        steep.follow(reading.read_light(estimate));
    };
    OrderSum sum = estimated_sum(first, correct(first, light_scale(first)), next, follow, progress);
    if (settings.orders > 0) {
        return solved_by(sum_of_first_orders(first, next, settings.orders, progress));
    }
    return solved_by(sum_of_orders(first, std::move(sum), next, correct, settings, progress));
}

SolvedLight solve_orders(const SkyMedium& medium, const SolverSettings& settings, int threads,
                         Progress* progress) {
    return settings.degree <= kLargestDegreeInFloats
               ? solve_orders_in<float>(medium, settings, threads, progress)
               : solve_orders_in<double>(medium, settings, threads, progress);
}

// Solves for the light at the levels of solution_levels_km.
SolvedLight solve_levels(const SkyMedium& medium, const SolverSettings& settings, int threads,
                         Progress* progress) {
    SolverSettings first = settings;
    first.degree = std::min(settings.degree, settings.degree_of_all_orders);
    // Uncut peaks of spheres are beyond moments of any degree here, and are added apart
    // (SplitPhase): refining would lose several percent of their light.
    if (settings.orders > 0 || has_peaks_of_spheres(medium) ||
        light_beyond_degree(medium, first.degree) <= kNegligibleLight) {
        return solve_orders(medium, settings, threads, progress);
    }
    first.first_zenith_nodes += first.first_zenith_nodes / 2;  // light scattered once is peaked
    const SkyMedium scaled = delta_scaled(medium, first.degree);
    SolvedLight light = solve_orders(scaled, first, threads, progress);
    if (is_cancelled(progress)) return light;
    add_forward_light(medium, scaled, light);
    SolverSettings last = settings;
    last.degree =
        std::max(settings.degree, std::min(sky_degree(medium), kFinerDegree * settings.degree));
    refine_light(medium, last, threads, progress, light);
    if (last.degree > settings.degree) {
        LightField wanted(light.light.levels, light.light.suns, settings.degree);
        copy_moments(light.light, wanted);
        light.light = std::move(wanted);
    }
    return light;
}

}  // namespace

SolverSettings finer(SolverSettings settings) {
    settings.level_scale *= 1.25;
    settings.zenith_nodes = settings.zenith_nodes * 3 / 2;
    settings.first_zenith_nodes = settings.first_zenith_nodes * 3 / 2;
    settings.ray_tolerance *= 0.7;
    return settings;
}

int sky_degree(const SkyMedium& medium) {
    int degree = kLeastSkyDegree;
    while (degree < kLargestDegree && light_beyond_degree(medium, degree) > kNegligibleLight) {
        degree += 4;
    }
    return degree;
}

SolvedLight solve_light(const SkyMedium& medium, const SolverSettings& settings, int threads,
                        Progress* progress) {
    assert(settings.degree >= 2 && settings.suns >= 8 && settings.suns % 8 == 0);
    assert(settings.orders >= 0);
    SolvedLight light = solve_levels(medium, settings, threads, progress);
    const ReadingLevels reading(medium.air, light.altitudes_km);
    light.light = reading.read_light(light.light);
    light.altitudes_km = reading.altitudes_km();
    return light;
}

}  // namespace skybake
