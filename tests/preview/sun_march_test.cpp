// How far a march towards the sun goes.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "bakers/march/layer_march.h"
#include "tests/preview/clouds.h"

namespace skybake {
namespace {

// 1200 x 900 x 600 m.
CloudMedium block(bool repeats) {
    const std::vector<float> voxels(8, 1.0F);
    return cloud_medium(test::cloud_of({1200, 900, 600}, 500), voxels.data(), {2, 2, 2}, 1, 1,
                        repeats);
}

// A march from the base to the top, whose sides are 600 m and 600 m / tan: 1200 m at 30 degrees.
TEST(SunMarch, EndsWhereSunlightEnters) {
    for (const bool repeats : {true, false}) {
        const CloudMedium medium = block(repeats);
        EXPECT_NEAR(sun_march_length_m(medium, {90, 0}), 600, 1e-9);
        EXPECT_NEAR(sun_march_length_m(medium, {45, 20}), 600 * std::sqrt(2), 1e-9);
        EXPECT_NEAR(sun_march_length_m(medium, {30.1, 20}), 1200, 5);
    }
    EXPECT_NEAR(sun_march_length_m(block(true), {-45, 20}), 600 * std::sqrt(2), 1e-9);
}

// Under a lower sun it ends after the longer edge of a tile, and after the diagonal of one that stands alone.
TEST(SunMarch, IsNotLongerThanATile) {
    for (const double elevation : {20.0, 1.0, 0.0, -5.0}) {
        EXPECT_NEAR(sun_march_length_m(block(true), {elevation, 20}), 1200, 1e-9) << elevation;
        EXPECT_NEAR(sun_march_length_m(block(false), {elevation, 20}), 1500, 1e-9) << elevation;
    }
}

}  // namespace
}  // namespace skybake
