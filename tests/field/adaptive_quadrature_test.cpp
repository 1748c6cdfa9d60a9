#include "bakers/math/quadrature.h"

#include <gtest/gtest.h>

#include <cmath>

namespace skybake {
namespace {

using Pair = std::array<double, 2>;

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
