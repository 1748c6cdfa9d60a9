#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>

#include "bakers/math/quadrature.h"

namespace skybake {
namespace {

using Pair = std::array<double, 2>;

// Every cell of a 4x4 grid holds about its share of the points.
void expect_even(const std::vector<PointRow>& rows, int count, int slack) {
    std::array<int, 16> cells{};
    for (const PointRow& row : rows) {
        for (const double x : row.x) {
            ASSERT_GE(x, 0);
            ASSERT_LT(x, 1);
            ++cells[static_cast<std::size_t>(static_cast<int>(row.y * 4) * 4 +
                                             static_cast<int>(x * 4))];
        }
    }
    for (const int cell : cells) EXPECT_NEAR(cell, count / 16, slack);
}

TEST(LowDiscrepancy, FillsTheSquareEvenly) {
    expect_even(low_discrepancy_points(1024, 1), 1024, 4);
    expect_even(low_discrepancy_points(1024, 16), 16384, 40);
    expect_even(low_discrepancy_points(8, 8), 64, 3);
}

// g^4 = g + 1, of which the steps are powers.
TEST(LowDiscrepancyPoint, IsRobertsSequence) {
    double g = 1.2;
    for (int i = 0; i < 100; ++i) g = std::sqrt(std::sqrt(g + 1));
    for (const int index : {0, 1, 2, 100, 16383}) {
        const std::array<double, 3> point = low_discrepancy_point(index);
        double step = 1;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            step /= g;
            const double sum = 0.5 + step * (index + 1);
            EXPECT_NEAR(point[axis], sum - std::floor(sum), 1e-11) << index << ' ' << axis;
        }
    }
}

TEST(LowDiscrepancyPoint, FillsTheCubeEvenly) {
    std::array<int, 64> cells{};
    std::array<std::array<int, 64>, 3> slices{};
    for (int i = 0; i < 4096; ++i) {
        std::size_t cell = 0;
        const std::array<double, 3> point = low_discrepancy_point(i);
        for (std::size_t axis = 0; axis < 3; ++axis) {
            ASSERT_GE(point[axis], 0);
            ASSERT_LT(point[axis], 1);
            cell = cell * 4 + static_cast<std::size_t>(point[axis] * 4);
            ++slices[axis][static_cast<std::size_t>(point[axis] * 64)];
        }
        ++cells[cell];
    }
    // Random points would be sqrt(64) = 8 off and, at the worst of 64, about 20.
    for (const int count : cells) EXPECT_NEAR(count, 64, 9);
    for (const auto& axis : slices) {
        for (const int count : axis) EXPECT_NEAR(count, 64, 5);
    }
}

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

TEST(AdaptiveQuadrature, KnownIntegrals) {
    const auto f = [](double x) { return Pair{std::exp(-x), std::sqrt(x)}; };
    const Pair sum = adaptive_integral<Pair>(f, 0, 4, 1e-12, 0);
    EXPECT_NEAR(sum[0], 1 - std::exp(-4.0), 1e-14);
    EXPECT_NEAR(sum[1], 16.0 / 3, 1e-11);
}

TEST(AdaptiveQuadrature, FindsAJumpBetweenItsNodes) {
    const auto f = [](double x) { return Pair{x < 0.3141592 ? 1.0 : 0.0, 1.0}; };
    const Pair sum = adaptive_integral<Pair>(f, 0, 1, 1e-9, 1e-9, 40);
    EXPECT_NEAR(sum[0], 0.3141592, 1e-8);
    EXPECT_NEAR(sum[1], 1, 1e-15);
}

}  // namespace
}  // namespace skybake
