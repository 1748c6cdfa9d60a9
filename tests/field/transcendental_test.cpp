#include "bakers/math/transcendental.h"

#include <gtest/gtest.h>

#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cmath>
#include <vector>

#include "bakers/math/quadrature.h"

namespace skybake {
namespace {

using Quad = boost::multiprecision::cpp_bin_float_quad;

std::vector<double> samples(double from, double to, int count) {
    std::vector<double> result;
    for (const PointRow& row : low_discrepancy_points(count, 1)) {
        result.push_back(from + (to - from) * row.x.front());
    }
    return result;
}

double ulps(double value, const Quad& exact) {
    const double rounded = static_cast<double>(exact);
    const double step = std::nextafter(std::fabs(rounded), INFINITY) - std::fabs(rounded);
    return static_cast<double>(abs(Quad(value) - exact) / step);
}

TEST(Transcendental, ExponentialIsWithinOneAndAHalfUlp) {
    for (const auto& [from, to] : {std::pair{-1e-3, 1e-3}, {-2.0, 2.0}, {-708.0, 709.0}}) {
        double worst = 0;
        for (const double x : samples(from, to, 20000)) {
            worst = std::max(worst, ulps(exponential(x), exp(Quad(x))));
        }
        EXPECT_LT(worst, 1.5) << from;
    }
}

TEST(Transcendental, ExponentialAtItsEnds) {
    EXPECT_EQ(exponential(0), 1);
    EXPECT_EQ(exponential(-0.0), 1);
    EXPECT_EQ(exponential(-709), 0);
    EXPECT_EQ(exponential(-1e300), 0);
    EXPECT_EQ(exponential(-INFINITY), 0);
    EXPECT_EQ(exponential(710), INFINITY);
    EXPECT_EQ(exponential(INFINITY), INFINITY);
    EXPECT_TRUE(std::isnormal(exponential(-707.9)));
}

TEST(Transcendental, LogarithmIsWithinOneAndAHalfUlp) {
    for (const auto& [from, to] :
         {std::pair{0.5, 2.0}, {0.999, 1.001}, {1e-300, 1e-290}, {1.0, 1e300}}) {
        double worst = 0;
        for (const double x : samples(from, to, 20000)) {
            worst = std::max(worst, ulps(logarithm(x), log(Quad(x))));
        }
        EXPECT_LT(worst, 1.5) << from;
    }
    EXPECT_EQ(logarithm(1), 0);
}

TEST(Transcendental, CosinesAreExactToTheLastBitsOfOne) {
    const Quad pi = boost::math::constants::pi<Quad>();
    for (const double x : samples(-1, 1, 20000)) {
        EXPECT_NEAR(arc_cosine(x), static_cast<double>(acos(Quad(x))), 4.5e-16) << x;
    }
    for (const double x : samples(0, 1, 20000)) {
        EXPECT_NEAR(cosine_of_pi(x), static_cast<double>(cos(pi * Quad(x))), 3e-16) << x;
    }
    EXPECT_EQ(arc_cosine(1), 0);
    EXPECT_EQ(cosine_of_pi(0.5), 0);
    EXPECT_NEAR(arc_cosine(-1), 3.14159265358979, 1e-14);
}

TEST(Transcendental, SinesAreExactToTheLastBitsOfOneForLargeArguments) {
    double worst = 0;
    const auto compare = [&](double x) {
        const auto [sine, cosine] = sine_and_cosine(x);
        worst = std::max({worst, std::fabs(static_cast<double>(Quad(sine) - sin(Quad(x)))),
                          std::fabs(static_cast<double>(Quad(cosine) - cos(Quad(x))))});
    };
    for (const double end : {1.0, 1e3, 1e6}) {
        for (const double x : samples(-end, end, 20000)) compare(x);
    }
    // The doubles about multiples of pi / 2, of which little is left.
    for (int n = 1; n < 600000; n += 997) compare(n * 1.5707963267948966);
    EXPECT_LT(worst, 3e-16);
    EXPECT_EQ(sine_and_cosine(0).sine, 0);
    EXPECT_EQ(sine_and_cosine(0).cosine, 1);
    EXPECT_EQ(sine_and_cosine(1e-300).sine, 1e-300);
}

TEST(Transcendental, ManyAtOnceHaveTheSameBits) {
    std::vector<double> values = samples(-800, 720, 1003);
    std::vector<double> one_by_one = values;
    for (double& value : one_by_one) value = exponential(value);
    exponentials(values.data(), static_cast<int>(values.size()));
    EXPECT_EQ(values, one_by_one);
}

}  // namespace
}  // namespace skybake
