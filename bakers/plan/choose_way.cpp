#include "bakers/plan/choose_way.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <utility>

namespace skybake {

namespace {

std::array<double, 4> figures_of(const WayFigures& way) {
    return {way.error, way.fetches, way.operations, way.bytes};
}

// Whether the first is at least as good as the second in all.
bool no_worse(const WayFigures& first, const WayFigures& second) {
    return std::ranges::equal(figures_of(first), figures_of(second), std::less_equal<>());
}

// Figures without a limit come first; the others break ties.
auto order_of(const WayLimits& limits, const WayFigures& way) {
    const WayFigures unlimited = {limits.error ? 0 : way.error, limits.fetches ? 0 : way.fetches,
                                  limits.bytes ? 0 : way.bytes, way.operations};
    return std::pair(figures_of(unlimited), figures_of(way));
}

}  // namespace

bool keeps(const WayLimits& limits, const WayFigures& way) {
    return way.error <= limits.error.value_or(way.error) &&
           way.fetches <= limits.fetches.value_or(way.fetches) &&
           way.bytes <= limits.bytes.value_or(way.bytes);
}

std::vector<bool> front_of(std::span<const WayFigures> ways) {
    std::vector<bool> front;
    for (std::size_t i = 0; i < ways.size(); ++i) {
        bool beaten = false;
        for (std::size_t j = 0; j < ways.size(); ++j) {
            beaten =
                beaten || (no_worse(ways[j], ways[i]) && (j < i || !no_worse(ways[i], ways[j])));
        }
        front.push_back(!beaten);
    }
    return front;
}

std::optional<std::size_t> best_within(const WayLimits& limits, std::span<const WayFigures> ways,
                                       double noise) {
    const auto least = [&](const WayLimits& within, const WayLimits& order) {
        std::optional<std::size_t> best;
        for (std::size_t i = 0; i < ways.size(); ++i) {
            if (!keeps(within, ways[i])) continue;
            if (!best || order_of(order, ways[i]) < order_of(order, ways[*best])) best = i;
        }
        return best;
    };
    const std::optional<std::size_t> best = least(limits, limits);
    if (!best || limits.error) return best;
    WayLimits near = limits;
    near.error = ways[*best].error + noise;
    return least(near, near);
}

std::size_t knee_of(std::span<const WayFigures> ways) {
    const auto order = [](const WayFigures& way) {
        const double cost = way.fetches * std::sqrt(std::max(way.bytes, kCachedBytes));
        return std::pair(way.error * std::sqrt(cost), figures_of(way));
    };
    const auto knee = std::ranges::min_element(
        ways, [&](const WayFigures& a, const WayFigures& b) { return order(a) < order(b); });
    return static_cast<std::size_t>(knee - ways.begin());
}

}  // namespace skybake
