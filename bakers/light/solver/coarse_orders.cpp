#include "bakers/light/solver/coarse_orders.h"

#include <algorithm>

#include "bakers/air/optical_depth.h"
#include "bakers/math/parallel.h"

namespace skybake {
namespace {

constexpr int kCoarseDegree = 2;
constexpr int kLeastZenithNodes = 4;
// The coarse sum need not be closer than this share of what it begins with.
constexpr double kEnoughOfResidual = 0.1;
constexpr int kMostCoarseApplications = 60;

// Returns every second level, but more where the air between two is thick: by its zenith optical
// depth.
std::vector<std::size_t> coarse_levels(const Medium& air, const std::vector<double>& levels_km) {
    constexpr double kThick = 0.5;
    const auto depth_above = [&](std::size_t level) {
        const double altitude_km = levels_km[level];
        return optical_depth_to_top(air, altitude_km, air.ground_radius_km + altitude_km);
    };
    std::vector<std::size_t> levels = {0};
    while (levels.back() + 1 < levels_km.size()) {
        const std::size_t next = std::min(levels.back() + 2, levels_km.size() - 1);
        const bool is_thin = largest(depth_above(levels.back()) - depth_above(next)) <= kThick;
        levels.push_back(is_thin ? next : levels.back() + 1);
    }
    return levels;
}

}  // namespace

CoarseOrders::CoarseOrders(const SkyMedium& medium, const SolvedLight& fine, int zenith_nodes,
                           double ray_tolerance, int threads)
    : levels_(coarse_levels(medium.air, fine.altitudes_km)),
      suns_(fine.suns),
      steep_(fine.steep),
      threads_(threads) {
    std::vector<double> levels_km;
    for (const std::size_t level : levels_) levels_km.push_back(fine.altitudes_km[level]);
    for (const double altitude_km : fine.altitudes_km) {
        const auto above = std::ranges::upper_bound(levels_km, altitude_km);
        const auto i =
            std::min(static_cast<std::size_t>(above - levels_km.begin()), levels_km.size() - 1) - 1;
        fine_places_.push_back({static_cast<int>(i),
                                (altitude_km - levels_km[i]) / (levels_km[i + 1] - levels_km[i])});
    }
    const LayerMoments moments(medium, kCoarseDegree);
    transports_.resize(levels_.size());
    parallel_for(static_cast<int>(levels_.size()), threads, [&](int level) {
        transports_[static_cast<std::size_t>(level)] = make_level_transport<float>(
            medium,
            make_ray_fan(medium, levels_km, level, std::max(zenith_nodes / 2, kLeastZenithNodes),
                         2 * ray_tolerance),
            moments);
    });
}

void CoarseOrders::next_order(const LightField& light, LightField& image) const {
    apply_transports(transports_, suns_, steep_, BlockedLight<float>(light, threads_), threads_,
                     image);
}

LightField CoarseOrders::restricted(const LightField& fine) const {
    LightField coarse(static_cast<int>(levels_.size()), fine.suns, kCoarseDegree);
    for (std::size_t level = 0; level < levels_.size(); ++level) {
        for (int sun = 0; sun < fine.suns; ++sun) {
            std::copy_n(fine.at(static_cast<int>(levels_[level]), sun), coarse.sun_size(),
                        coarse.at(static_cast<int>(level), sun));
        }
    }
    coarse.sky_irradiance = fine.sky_irradiance;
    return coarse;
}

LightScale CoarseOrders::restricted(const LightScale& scale) const {
    const std::size_t row = suns_.cosines.size() * kChannelSlots;
    LightScale coarse;
    const auto add_row = [&](std::size_t from) {
        const auto first = scale.begin() + static_cast<std::ptrdiff_t>(from * row);
        coarse.insert(coarse.end(), first, first + static_cast<std::ptrdiff_t>(row));
    };
    for (const std::size_t level : levels_) add_row(level);
    add_row(fine_places_.size());  // the sky's irradiance
    return coarse;
}

void CoarseOrders::add_prolonged(const LightField& coarse, const LightScale& coarse_scale,
                                 const LightScale& fine_scale, LightField& fine) const {
    const std::size_t suns = suns_.cosines.size();
    const auto scale_at = [suns](const LightScale& scale, int level, int sun) {
        return scale.data() +
               (static_cast<std::size_t>(level) * suns + static_cast<std::size_t>(sun)) *
                   kChannelSlots;
    };
    for (int level = 0; level < fine.levels; ++level) {
        const auto& [low, fraction] = fine_places_[static_cast<std::size_t>(level)];
        for (int sun = 0; sun < fine.suns; ++sun) {
            const double* here = scale_at(fine_scale, level, sun);
            const double* below = scale_at(coarse_scale, low, sun);
            const double* above = scale_at(coarse_scale, low + 1, sun);
            const double* from_below = coarse.at(low, sun);
            const double* from_above = coarse.at(low + 1, sun);
            double* to = fine.at(level, sun);
            for (std::size_t i = 0; i < coarse.sun_size(); ++i) {
                const std::size_t c = i % kChannelSlots;
                to[i] += here[c] * ((1 - fraction) * from_below[i] / below[c] +
                                    fraction * from_above[i] / above[c]);
            }
        }
    }
    for (std::size_t i = 0; i < fine.sky_irradiance.size(); ++i) {
        fine.sky_irradiance[i] += coarse.sky_irradiance[i];
    }
}

LightField CoarseOrders::sum_from(const LightField& residual, const LightScale& scale,
                                  Progress* progress) const {
    const LightScale coarse_scale = restricted(scale);
    const NextOrder next = [this](const LightField& light, LightField& image) {
        next_order(light, image);
    };
    LightField second(static_cast<int>(levels_.size()), residual.suns, kCoarseDegree);
    LightField sum = second;
    next_order(restricted(residual), second);
    const ResidualSearch search = {kEnoughOfResidual * mean_share(second, coarse_scale),
                                   kMostCoarseApplications};
    search_residual(next, {}, coarse_scale, search, progress, second, sum);
    LightField all = residual;
    add_prolonged(sum, coarse_scale, scale, all);
    return all;
}

}  // namespace skybake
