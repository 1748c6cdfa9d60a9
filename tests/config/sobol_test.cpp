#include "config/sweep/sobol.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <vector>

namespace skybake::config {
namespace {

// The first points that Joe and Kuo's own program prints.
TEST(Sobol, IsTheSequenceOfJoeAndKuo) {
    const std::vector<std::vector<double>> points = {
        {0, 0, 0},
        {0.5, 0.5, 0.5},
        {0.75, 0.25, 0.25},
        {0.25, 0.75, 0.75},
        {0.375, 0.375, 0.625},
        {0.875, 0.875, 0.125},
        {0.625, 0.125, 0.875},
        {0.125, 0.625, 0.375},
        {0.1875, 0.3125, 0.9375},
        {0.6875, 0.8125, 0.4375},
    };
    for (std::uint32_t i = 0; i < points.size(); ++i) {
        for (int d = 0; d < 3; ++d) {
            EXPECT_EQ(sobol_coordinate(i, d), points[i][static_cast<std::size_t>(d)]) << i;
        }
    }
}

// One point in each of 2^k equal parts: a slip in any direction number breaks this.
TEST(Sobol, EveryDimensionIsStratified) {
    for (int d = 0; d < sobol_dimensions; ++d) {
        for (const std::uint32_t start : {0u, 1024u, 7168u}) {
            std::set<int> parts;
            for (std::uint32_t i = start; i < start + 1024; ++i) {
                parts.insert(static_cast<int>(sobol_coordinate(i, d) * 1024));
            }
            EXPECT_EQ(parts.size(), 1024u) << d;
        }
    }
}

// Sobol's property A: the first 2^s points have one in each of the 2^s halves of halves.
TEST(Sobol, TheFirstPointsMeetEveryOrthant) {
    std::set<unsigned> orthants;
    for (std::uint32_t i = 0; i < 1u << sobol_dimensions; ++i) {
        unsigned orthant = 0;
        for (int d = 0; d < sobol_dimensions; ++d) {
            if (sobol_coordinate(i, d) >= 0.5) orthant |= 1u << d;
        }
        orthants.insert(orthant);
    }
    EXPECT_EQ(orthants.size(), std::size_t{1} << sobol_dimensions);
}

// Two dimensions together: no quarter of the square is left out for long.
TEST(Sobol, EveryPairIsEven) {
    for (int a = 0; a < sobol_dimensions; ++a) {
        for (int b = a + 1; b < sobol_dimensions; ++b) {
            std::vector<int> counts(64, 0);
            for (std::uint32_t i = 0; i < 4096; ++i) {
                const int row = static_cast<int>(sobol_coordinate(i, a) * 8);
                const int column = static_cast<int>(sobol_coordinate(i, b) * 8);
                ++counts[static_cast<std::size_t>(row * 8 + column)];
            }
            const auto [least, most] = std::minmax_element(counts.begin(), counts.end());
            EXPECT_EQ(*least, 64) << a << ' ' << b;
            EXPECT_EQ(*most, 64) << a << ' ' << b;
        }
    }
}

}  // namespace
}  // namespace skybake::config
