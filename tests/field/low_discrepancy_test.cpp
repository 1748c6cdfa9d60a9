#include "bakers/math/quadrature.h"

#include <gtest/gtest.h>

#include <array>
#include <cstddef>

namespace skybake {
namespace {

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

}  // namespace
}  // namespace skybake
