// The functions of gpu.h are as inexact as it says: neither better, nor worse.
#include "tests/lookups/gpu.h"

#include <gtest/gtest.h>

#include <numbers>

namespace skybake::gpu {
namespace {

template <class Function, class Exact>
double largest_error(const Function& function, const Exact& exact, double low, double high) {
    double largest = 0;
    for (int i = 0; i <= 100000; ++i) {
        const auto x = static_cast<float>(low + (high - low) * i / 100000);
        largest = std::max(largest, std::fabs(double{function(x)} - exact(double{x})));
    }
    return largest;
}

TEST(Gpu, ArcFunctionsAreMesas) {
    const double arc_sine = largest_error([](float x) { return gpu::asin(x); },
                                          [](double x) { return std::asin(x); }, -1, 1);
    EXPECT_GT(arc_sine, 3e-4);
    EXPECT_LT(arc_sine, 5e-4);
    const double arc_cosine = largest_error([](float x) { return gpu::acos(x); },
                                            [](double x) { return std::acos(x); }, -1, 1);
    EXPECT_GT(arc_cosine, 1e-4);
    EXPECT_LT(arc_cosine, 3e-4);
    const auto arc = [](float x, float y) { return gpu::atan(y, x); };
    const double arc_tangent =
        largest_error([&](float t) { return arc(std::cos(t), std::sin(t)); },
                      [](double t) { return std::atan2(std::sin(t), std::cos(t)); }, -3.14, 3.14);
    EXPECT_GT(arc_tangent, 1e-6);
    EXPECT_LT(arc_tangent, 5e-6);
    EXPECT_NEAR(gpu::atan(1e-4f, 1.0f), 1e-4, 3e-9);
    EXPECT_FLOAT_EQ(gpu::atan(-1.0f, 0.0f), -0.5f * std::numbers::pi_v<float>);
    EXPECT_FLOAT_EQ(gpu::atan(0.0f, -1.0f), std::numbers::pi_v<float>);
}

TEST(Gpu, RootsAndLogarithmsAreVulkans) {
    const double root = largest_error([](float x) { return gpu::sqrt(x); },
                                      [](double x) { return std::sqrt(x); }, 1, 4);
    EXPECT_GT(root, 0x1p-22);
    EXPECT_LE(root, 4 * 0x1p-22);
    EXPECT_EQ(gpu::sqrt(0.0f), 0);
    const double logarithm = largest_error([](float x) { return gpu::log(x); },
                                           [](double x) { return std::log(x); }, 0.5, 2);
    EXPECT_GT(logarithm, 0x1p-22);
    EXPECT_LE(logarithm, 0x1p-21 + 0x1p-24);
}

}  // namespace
}  // namespace skybake::gpu
