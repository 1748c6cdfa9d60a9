#include "bakers/air/quadrature_rules.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "bakers/math/quadrature.h"
#include "bakers/math/transcendental.h"

namespace skybake {
namespace {

// Returns the index of the rule: 0, 1, 2 and 3 for 1, 2, 4 and 8 nodes.
std::size_t index_of(int count) { return count >= 8 ? 3U : count >= 4 ? 2U : count >= 2 ? 1U : 0U; }

AzimuthRule make_full_circle_rule(int count) {
    AzimuthRule rule{count, {}, {}};
    for (int i = 0; i < count; ++i) {
        rule.nodes[i] = cosine_of_pi((i + 0.5) / count);
        rule.weights[i] = 1.0 / count;
    }
    return rule;
}

AzimuthRule make_lit_part_rule(int count) {
    const QuadratureRule gauss = gauss_legendre(count);
    AzimuthRule rule{count, {}, {}};
    std::ranges::copy(gauss.nodes, rule.nodes);
    std::ranges::copy(gauss.weights, rule.weights);
    return rule;
}

}  // namespace

const AzimuthRule& full_circle_rule(int count) {
    assert(count == 1 || count == 2 || count == 4 || count == 8);
    static const std::array<AzimuthRule, 4> rules = {
        make_full_circle_rule(1), make_full_circle_rule(2), make_full_circle_rule(4),
        make_full_circle_rule(8)};
    return rules[index_of(count)];
}

const AzimuthRule& lit_part_rule(int count) {
    assert(count == 1 || count == 2 || count == 4 || count == 8);
    static const std::array<AzimuthRule, 4> rules = {make_lit_part_rule(4), make_lit_part_rule(4),
                                                     make_lit_part_rule(4), make_lit_part_rule(8)};
    return rules[index_of(count)];
}

const ClimbRule& climb_rule() {
    static const ClimbRule rule = [] {
        const QuadratureRule gauss = gauss_legendre(kClimbNodes);
        ClimbRule result{};
        for (int i = 0; i < kClimbNodes; ++i) {
            result.nodes[i] = gauss.nodes[static_cast<std::size_t>(i)];
            result.half_weights[i] = 0.5 * gauss.weights[static_cast<std::size_t>(i)];
        }
        return result;
    }();
    return rule;
}

std::vector<ZenithPart> zenith_parts(double horizon, double height, int zenith_nodes) {
    assert(horizon >= -1 && horizon <= 0 && zenith_nodes >= 1);
    const auto share = [&](double part) {
        return std::max(2, static_cast<int>(std::lround(part * zenith_nodes)));
    };
    std::vector<ZenithPart> parts = {{horizon, -1, true, share(0.5 + 0.2 * height)}};
    if (horizon < 0) parts.push_back({horizon, 0, false, share(0.7 + 0.7 * height)});
    parts.push_back({0, 1, false, share(0.7 - 0.4 * height)});
    return parts;
}

}  // namespace skybake
