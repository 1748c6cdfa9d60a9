// Laws of the projection onto winds without divergence.
#include "bakers/convection/projection.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/convection/fields.h"

namespace skybake::convection {
namespace {

using test::each_cell;
using test::largest_divergence;
using test::random_wind;

constexpr Grid kGrid{{24, 20, 17}, {40, 30, 25}};

double work(const Grid& grid, std::array<Field, 3>& one, const std::array<Field, 3>& other) {
    double sum = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        each_cell(grid, one[i], [&](float value, int x, int y, int z) {
            sum += double{value} * double{other[i].row(y, z)[x]};
        });
    }
    return sum;
}

TEST(Projection, LeavesDivergenceAtRounding) {
    for (const Grid& grid :
         {kGrid, Grid{{30, 16, 1}, {10, 10, 10}}, Grid{{8, 8, 60}, {100, 90, 20}}}) {
        std::array<Field, 3> wind = random_wind(grid, 3);
        const double before = largest_divergence(grid, wind);
        Projection(grid).project(wind, 2);
        // Winds are of about 1 m/s, and floats have 24 bits.
        EXPECT_LE(largest_divergence(grid, wind), 2e-6 / grid.edge_m[2]);
        EXPECT_GE(before, 1e-3);
    }
}

TEST(Projection, ChangesNothingTwice) {
    std::array<Field, 3> wind = random_wind(kGrid, 4);
    Projection projection(kGrid);
    projection.project(wind, 2);
    const std::array<Field, 3> once = wind;
    projection.project(wind, 2);
    for (std::size_t i = 0; i < 3; ++i) {
        each_cell(kGrid, wind[i], [&](float value, int x, int y, int z) {
            ASSERT_NEAR(value, once[i].row(y, z)[x], 2e-6);
        });
    }
}

// The part that it takes away does no work on any wind without divergence, so that no other such wind is nearer.
TEST(Projection, TakesTheNearestWind) {
    std::array<Field, 3> wind = random_wind(kGrid, 5);
    std::array<Field, 3> other = random_wind(kGrid, 6);
    const std::array<Field, 3> given = wind;
    Projection projection(kGrid);
    projection.project(wind, 2);
    projection.project(other, 2);
    std::array<Field, 3> taken = given;
    for (std::size_t i = 0; i < 3; ++i) {
        each_cell(kGrid, taken[i],
                  [&](float& value, int x, int y, int z) { value -= wind[i].row(y, z)[x]; });
    }
    const double size = std::sqrt(work(kGrid, taken, taken) * work(kGrid, other, other));
    EXPECT_GT(size, 100);
    EXPECT_LE(std::abs(work(kGrid, taken, other)), 1e-6 * size);
}

}  // namespace
}  // namespace skybake::convection
