// The sky of suns far below the horizon, which is lit by light that was scattered several times: its
// solution has a sun in every two degrees there, between which light falls to a tenth.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "tests/light/sky_media.h"

namespace skybake {
namespace {

using test::kDegree;

const SkyLight& earth() {
    static const SkyLight light(test::preset_atmosphere("earth_hillaire"), config::SkyOrders::all,
                                {}, {.threads = 2});
    return light;
}

Spectrum zenith_under(double elevation) {
    const SunZenith sun = sun_at_elevation(elevation * kDegree);
    const SkyDirection up = sky_direction(sun, 1, 0, 1);
    return earth().wanted(earth().integrator().radiance(0, sun, up));
}

// Down to -20 degrees the zenith darkens without steps or kinks: its rate, in decades per half a
// degree, changes by less than 0.03 from one half degree to the next.
TEST(DeepTwilight, FallsSmoothly) {
    for (std::size_t c = 0; c < 3; ++c) {
        std::vector<double> decades;
        for (double elevation = -1; elevation >= -20; elevation -= 0.5) {
            decades.push_back(std::log10(zenith_under(elevation)[c]));
        }
        for (std::size_t i = 1; i + 1 < decades.size(); ++i) {
            const double bend = decades[i + 1] - 2 * decades[i] + decades[i - 1];
            EXPECT_LT(std::fabs(bend), 0.03) << "sun " << -1 - 0.5 * static_cast<double>(i);
            EXPECT_LT(decades[i], decades[i - 1]);
        }
    }
}

// Between suns of the solution, where a line is 32 % too bright. The value was read from the logarithm of
// another solution's light under its suns. Paths of light cannot tell: 4 million of them are 14 to 46 % off
// under this sun, low above it.
TEST(DeepTwilight, FollowsTheLogarithmBetweenSuns) {
    EXPECT_NEAR(zenith_under(-15.5)[1] / 8.1e-10, 1, 0.12);
}

}  // namespace
}  // namespace skybake
