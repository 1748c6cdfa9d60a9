#include "config/optics/elementary.h"

#include <gtest/gtest.h>

#include <cmath>

namespace skybake::config {
namespace {

TEST(Elementary, FunctionsAreThoseOfTheLibraryToFifteenDigits) {
    for (double x = 1e-9; x < 1e9; x *= 1.37) {
        EXPECT_NEAR(logarithm(x), std::log(x), 1e-15 * std::fmax(std::fabs(std::log(x)), 1e-3))
            << x;
    }
    for (double x = -60; x < 60; x += 0.173) {
        EXPECT_NEAR(exponential(x) / std::exp(x), 1, 2e-15) << x;
    }
    for (double x = 1e-12; x < 60; x *= 1.37) {
        EXPECT_NEAR(exponential_less_one(x) / std::expm1(x), 1, 2e-15) << x;
        EXPECT_NEAR(exponential_less_one(-x) / std::expm1(-x), 1, 2e-15) << x;
    }
    EXPECT_EQ(exponential_less_one(-1e300), -1);
    for (double base = 0.3; base < 3; base += 0.09) {
        for (double exponent = -5; exponent < 5; exponent += 0.31) {
            EXPECT_NEAR(power(base, exponent) / std::pow(base, exponent), 1, 5e-15)
                << base << ' ' << exponent;
        }
    }
    EXPECT_EQ(power(1, 3.7), 1);
    EXPECT_EQ(exponential(0), 1);
}

}  // namespace
}  // namespace skybake::config
