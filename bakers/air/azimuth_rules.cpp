#include "bakers/air/azimuth_rules.h"

#include <algorithm>
#include <array>
#include <cstddef>

#include "bakers/math/gauss_legendre.h"
#include "bakers/math/transcendental.h"

namespace skybake {

namespace {

// Rules for 1, 2, 4 and 8 nodes stand at 0, 1, 2 and 3.
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
    std::copy(gauss.nodes.begin(), gauss.nodes.end(), rule.nodes);
    std::copy(gauss.weights.begin(), gauss.weights.end(), rule.weights);
    return rule;
}

}  // namespace

const AzimuthRule& full_circle_rule(int count) {
    static const std::array<AzimuthRule, 4> rules = {
        make_full_circle_rule(1), make_full_circle_rule(2), make_full_circle_rule(4),
        make_full_circle_rule(8)};
    return rules[index_of(count)];
}

const AzimuthRule& lit_part_rule(int count) {
    static const std::array<AzimuthRule, 4> rules = {make_lit_part_rule(4), make_lit_part_rule(4),
                                                     make_lit_part_rule(4), make_lit_part_rule(8)};
    return rules[index_of(count)];
}

}  // namespace skybake
