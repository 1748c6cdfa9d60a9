// The sky of suns far below the horizon, which is lit by light that was scattered several times: its
// solution has a sun in every two degrees there, between which light falls to a tenth.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "bakers/light/path_tracer/path_tracer.h"
#include "tests/light/sky_media.h"

namespace skybake {
namespace {

using test::kDegree;

const SkyLight& earth() {
    static const SkyLight light(test::preset_atmosphere("earth_hillaire"), config::SkyOrders::all,
                                {}, {.threads = 2});
    return light;
}

Spectrum sky_towards(const SunZenith& sun, const SkyDirection& direction) {
    return earth().wanted(earth().integrator().radiance(0, sun, direction));
}

Spectrum zenith_under(double elevation) {
    const SunZenith sun = sun_at_elevation(elevation * kDegree);
    return sky_towards(sun, sky_direction(sun, 1, 0, 1));
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

// Between suns of the solution, where a line is 32 % too bright. Low above the sun paths find light that
// they seldom find at the zenith, and none of 4 million is enough for suns below -17 degrees.
TEST(DeepTwilight, IsThatOfPaths) {
    const SkyMedium medium = make_sky_medium(test::preset_atmosphere("earth_hillaire"));
    const PathTracer tracer(medium);
    const SunZenith sun = sun_at_elevation(-15.5 * kDegree);
    const SkyDirection low = sky_direction(sun, std::sin(4 * kDegree), std::cos(4 * kDegree), 1);
    PathTracerSettings settings;
    settings.paths = std::int64_t{1} << 22;
    const PathTracedRadiance traced = trace_paths(tracer, 0, sun, low, settings, 2);
    const Spectrum found = sky_towards(sun, low);
    for (std::size_t c = 0; c < 3; ++c) {
        const double noise = traced.standard_error[c] / traced.radiance[c];
        EXPECT_LT(noise, 0.06);
        EXPECT_NEAR(found[c] / traced.radiance[c], 1, 3 * noise) << c;
    }
}

}  // namespace
}  // namespace skybake
