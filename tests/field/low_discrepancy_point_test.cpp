#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>

#include "bakers/math/quadrature.h"

namespace skybake {
namespace {

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

}  // namespace
}  // namespace skybake
