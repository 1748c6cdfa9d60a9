#include "bakers/plan/choose_way.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace skybake {
namespace {

bool beats(const WayFigures& a, const WayFigures& b) {
    const bool no_worse = a.error <= b.error && a.fetches <= b.fetches && a.bytes <= b.bytes;
    return no_worse && (a.error < b.error || a.fetches < b.fetches || a.bytes < b.bytes);
}

bool equal(const WayFigures& a, const WayFigures& b) {
    return a.error == b.error && a.fetches == b.fetches && a.bytes == b.bytes;
}

// Figures without a limit come first, in the order error, fetches, bytes; the others break ties.
std::array<double, 6> order_of(const WayLimits& limits, const WayFigures& way) {
    const std::array<double, 3> figures = {way.error, way.fetches, way.bytes};
    const std::array<bool, 3> limited = {limits.error.has_value(), limits.fetches.has_value(),
                                         limits.bytes.has_value()};
    std::array<double, 6> order{};
    for (std::size_t i = 0; i < 3; ++i) {
        if (!limited[i]) order[i] = figures[i];
        order[3 + i] = figures[i];
    }
    return order;
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
            beaten = beaten || beats(ways[j], ways[i]) || (j < i && equal(ways[j], ways[i]));
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
        return std::array{way.error * std::sqrt(cost), way.error, way.fetches, way.bytes};
    };
    const auto knee = std::ranges::min_element(
        ways, [&](const WayFigures& a, const WayFigures& b) { return order(a) < order(b); });
    return static_cast<std::size_t>(knee - ways.begin());
}

}  // namespace skybake
