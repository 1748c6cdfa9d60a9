// The transform against the sum that defines it.
#include "bakers/convection/hartley.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <vector>

namespace skybake::convection {
namespace {

double cas(double turns) {
    const double angle = 2 * std::numbers::pi * turns;
    return std::cos(angle) + std::sin(angle);
}

double by_definition(const std::vector<float>& plane, int columns, int rows, int m, int n) {
    double sum = 0;
    for (int y = 0; y < rows; ++y) {
        for (int x = 0; x < columns; ++x) {
            sum += double{plane[static_cast<std::size_t>(y * columns + x)]} *
                   cas(double(m) * x / columns) * cas(double(n) * y / rows);
        }
    }
    return sum;
}

TEST(Hartley, IsTheSumThatDefinesIt) {
    std::mt19937 random(1);
    std::uniform_real_distribution<float> number(-1, 1);
    for (const auto& [columns, rows] :
         {std::pair{2, 2}, {4, 6}, {10, 8}, {12, 18}, {16, 30}, {40, 50}, {54, 2}}) {
        std::vector<float> plane(static_cast<std::size_t>(columns * rows));
        for (float& value : plane) value = number(random);
        std::vector<float> transformed = plane;
        Hartley::Scratch scratch;
        const Hartley hartley(columns, rows);
        hartley.transform(transformed.data(), scratch);
        const double room = 1e-6 * std::sqrt(columns * rows);
        for (int n = 0; n < rows; ++n) {
            for (int m = 0; m < columns; ++m) {
                ASSERT_NEAR(double{transformed[static_cast<std::size_t>(n * columns + m)]},
                            by_definition(plane, columns, rows, m, n), room)
                    << columns << " x " << rows << " at " << m << ", " << n;
            }
        }
        hartley.transform(transformed.data(), scratch);
        for (std::size_t i = 0; i < plane.size(); ++i) {
            ASSERT_NEAR(transformed[i] / static_cast<float>(columns * rows), plane[i], 1e-6F);
        }
    }
}

TEST(Hartley, KnowsItsLengths) {
    for (const int length : {1, 2, 3, 4, 5, 6, 128, 192, 250, 486}) EXPECT_TRUE(is_smooth(length));
    for (const int length : {7, 14, 22, 34, 49, 254}) EXPECT_FALSE(is_smooth(length));
}

}  // namespace
}  // namespace skybake::convection
