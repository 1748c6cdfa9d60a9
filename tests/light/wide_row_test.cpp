// Rows of many azimuths against the same rows at each of them.
#include "bakers/light/wide_row.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cstdio>

#include "bakers/math/transcendental.h"
#include "tests/light/sky_media.h"

namespace skybake {
namespace {

using config::SkyOrders;
using test::kDegree;
using test::TestSky;
using test::uniform;

std::vector<double> even_azimuths(int count) {
    std::vector<double> azimuths;
    for (int i = 0; i < count; ++i) azimuths.push_back((i + 0.5) / count);
    return azimuths;
}

// The largest difference of the parts of a wide row from those of the row itself, relative to
// max(light, 1e-3 of the row's largest).
double error_of(const SkyLight& light, const SkyViewCamera& camera, double y, const SunZenith& sun,
                const std::vector<double>& azimuths) {
    const RowOfView view(camera, y, sun);
    const SkyRow row(light.integrator(), light.medium(), light.higher_orders(), view.ray(1),
                     &light.sunlight());
    std::vector<double> cosines;
    for (const double azimuth : azimuths) cosines.push_back(cosine_of_pi(azimuth));
    const auto wanted =
        row.radiance([&](double cosine) { return camera.ray(y, sun, cosine); }, cosines);
    const auto found = wide_radiance(row, light.medium(), view, azimuths);
    double scale = 0;
    for (const SkyRadiance& radiance : wanted) scale = std::max(scale, largest(radiance.total()));
    double error = 0;
    for (std::size_t i = 0; i < azimuths.size(); ++i) {
        const Spectrum parts[][2] = {{found[i].single, wanted[i].single},
                                     {found[i].multiple, wanted[i].multiple},
                                     {found[i].ground, wanted[i].ground}};
        EXPECT_EQ(found[i].transmittance, wanted[i].transmittance);
        for (const auto& [value, exact] : parts) {
            for (std::size_t c = 0; c < kMaxChannels; ++c) {
                const double floor = std::max(wanted[i].total()[c], 1e-3 * scale);
                if (floor > 0) error = std::max(error, std::fabs(value[c] - exact[c]) / floor);
            }
        }
    }
    return error;
}

TEST(WideRow, IsTheRow) {
    for (const char* preset : {"earth_hillaire", "mars_rgb", "tiny_planet", "dense_earth"}) {
        const TestSky sky(test::preset_atmosphere(preset), SkyOrders::all);
        double largest_error = 0;
        for (const double altitude_share : {0.0, 0.02, 5.0}) {
            const SkyViewCamera camera(sky.light().shell(),
                                       altitude_share * sky.light().shell().thickness_km);
            for (const double elevation : {90.0, 30.0, 2.0, 0.0, -4.0}) {
                const SunZenith sun = sun_at_elevation(elevation * kDegree);
                for (const double y : {0.0, 0.3, 0.49, 0.51, 0.8, 1.0}) {
                    const double error = error_of(sky.light(), camera, y, sun, even_azimuths(300));
                    EXPECT_LT(error, 2e-5) << preset << " altitude " << altitude_share << " sun "
                                           << elevation << " y " << y;
                    largest_error = std::max(largest_error, error);
                }
            }
        }
        std::printf("  %s: largest error %.1e\n", preset, largest_error);
    }
}

RC_GTEST_PROP(WideRow, IsTheRowInAnyAir, ()) {
    const TestSky sky(test::random_atmosphere(), SkyOrders::all);
    const SkyViewCamera camera(sky.light().shell(),
                               uniform(0, 1.2) * sky.light().shell().thickness_km);
    const SunZenith sun = sun_at_elevation(uniform(-20, 90) * kDegree);
    std::vector<double> azimuths;
    const int count = *rc::gen::inRange(1, 90);
    for (int i = 0; i < count; ++i) azimuths.push_back(uniform(0, 1));
    RC_ASSERT(error_of(sky.light(), camera, camera.off_the_edges(uniform(0, 1)), sun, azimuths) <
              2e-5);
}

// Any order, the same azimuth more than once, and both ends.
TEST(WideRow, TakesAnyAzimuths) {
    const TestSky sky(test::preset_atmosphere("earth_hillaire"), SkyOrders::all);
    const SkyViewCamera camera(sky.light().shell(), 1);
    const SunZenith sun = sun_at_elevation(10 * kDegree);
    std::vector<double> azimuths = {1, 0, 0.5, 0.5, 1};
    EXPECT_LT(error_of(sky.light(), camera, 0.7, sun, azimuths), 1e-12);
    for (int i = 0; i < 100; ++i) azimuths.push_back(std::fmod(0.618034 * i, 1));
    for (int i = 0; i < 50; ++i) azimuths.push_back(azimuths[static_cast<std::size_t>(7 * i % 60)]);
    EXPECT_LT(error_of(sky.light(), camera, 0.7, sun, azimuths), 2e-5);
    EXPECT_EQ(error_of(sky.light(), camera, 0.7, sun, {}), 0);
}

}  // namespace
}  // namespace skybake
