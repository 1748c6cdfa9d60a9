#include "bakers/air/climb_quadrature.h"

#include <cstddef>

#include "bakers/math/gauss_legendre.h"

namespace skybake {

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

}  // namespace skybake
