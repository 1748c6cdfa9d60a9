#include "bakers/math/quadrature.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <numeric>

namespace skybake {
namespace {

TEST(GaussLegendre, IntegratesPolynomialsOfItsDegree) {
    for (int count = 1; count <= 64; ++count) {
        const QuadratureRule rule = gauss_legendre(count);
        for (int degree = 0; degree < 2 * count; ++degree) {
            double sum = 0;
            for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
                sum += rule.weights[i] * std::pow(rule.nodes[i], degree);
            }
            EXPECT_NEAR(sum, 1.0 / (degree + 1), 4e-15) << count << " nodes, degree " << degree;
        }
    }
}

TEST(GaussLegendre, NodesAscendInsideAndWeightsArePositive) {
    for (int count = 1; count <= 64; ++count) {
        const QuadratureRule rule = gauss_legendre(count);
        double last = 0;
        for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
            EXPECT_GT(rule.nodes[i], last);
            EXPECT_LT(rule.nodes[i], 1);
            EXPECT_GT(rule.weights[i], 0);
            last = rule.nodes[i];
        }
    }
}

TEST(GaussLegendre, KnownNodes) {
    // Abramowitz & Stegun, table 25.4, n = 3, moved to [0, 1].
    const QuadratureRule rule = gauss_legendre(3);
    EXPECT_NEAR(rule.nodes[0], 0.5 - 0.5 * 0.774596669241483, 1e-15);
    EXPECT_EQ(rule.nodes[1], 0.5);
    EXPECT_NEAR(rule.weights[0], 0.5 * 0.555555555555556, 1e-15);
}

}  // namespace
}  // namespace skybake
