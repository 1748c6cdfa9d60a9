#include "bakers/assets/environment/environment_table.h"
#include "bakers/field/baked.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "bakers/light/sky_irradiance.h"
#include "tests/light/sky_media.h"
#include "tests/support/outcomes.h"

namespace skybake {
namespace {

using config::SkyOrders;
using test::kDegree;
using test::TestSky;

config::EnvironmentBake bake_of(std::array<int, 2> size, double altitude_km, double sun) {
    config::EnvironmentBake bake;
    bake.size = size;
    bake.altitude = {altitude_km * 1000};
    bake.sun_elevation = {sun * kDegree};
    return bake;
}

Baked bake(const SkyLight& light, const config::EnvironmentBake& asset,
           Certification certification = Certification::off) {
    Baked table;
    table.name = "around";
    table.channel_names = {"R", "G", "B"};
    return test::without_errors(
        bake_environment(light, asset, {.threads = 1, .certification = certification}, table));
}

// The integral over the sphere is no part of the baker: the sum over the upper half of radiance,
// cosine and solid angle is the irradiance of a level surface.
TEST(Environment, LightsALevelSurfaceAsTheSkyDoes) {
    const TestSky sky(test::preset_atmosphere("earth_hillaire"), SkyOrders::all);
    for (const double sun : {60.0, 20.0, -3.0}) {
        const Baked baked = bake(sky.light(), bake_of({256, 256}, 0, sun));
        std::array<double, 3> sum{};
        for (int y = 0; y < 128; ++y) {
            const double elevation = kDegree * 180 * (0.5 - (y + 0.5) / 256);
            const double weight = std::sin(elevation) * std::cos(elevation) *
                                  (std::numbers::pi / 256) * (2 * std::numbers::pi / 256);
            for (int x = 0; x < 256; ++x) {
                for (std::size_t c = 0; c < 3; ++c) {
                    sum[c] += weight * baked.image().texel(x, y)[c];
                }
            }
        }
        const Spectrum wanted =
            sky_irradiance(sky.light(), 0, std::sin(sun * kDegree), {28, 32, 12});
        for (std::size_t c = 0; c < 3; ++c) {
            EXPECT_NEAR(sum[c], wanted[c], 5e-3 * wanted[c]) << sun << " " << c;
        }
    }
}

// Each texel is the integral along its own ray, whose direction stands here in plain trigonometry.
TEST(Environment, HoldsWhatTheIntegratorSees) {
    const TestSky sky(test::preset_atmosphere("earth_hillaire"), SkyOrders::all);
    const Baked baked = bake(sky.light(), bake_of({64, 32}, 0.5, 10));
    const Shell shell = sky.light().shell();
    const double r = shell.ground_radius_km + 0.5;
    for (const auto& [x, y] : {std::pair{0, 3}, {31, 14}, {40, 10}, {63, 12}, {20, 25}, {7, 31}}) {
        const double azimuth = 2 * std::numbers::pi * ((x + 0.5) / 64 - 0.5);
        const double elevation = std::numbers::pi * (0.5 - (y + 0.5) / 32);
        const double sun = 10 * kDegree;
        const double cosine = std::sin(elevation) * std::sin(sun) +
                              std::cos(elevation) * std::cos(sun) * std::cos(azimuth);
        SkyRay ray;
        ray.altitude_km = 0.5;
        ray.s_km = r * std::sin(elevation);
        ray.sun_s_km = r * std::sin(sun);
        ray.cosine_to_sun = cosine;
        ray.one_minus_cosine = 1 - cosine;
        ray.one_plus_cosine = 1 + cosine;
        ray.meets_ground = elevation < -std::acos(shell.ground_radius_km / r);
        ray.length_km = ray_length_km(shell, ray.altitude_km, ray.s_km, ray.meets_ground);
        const Spectrum wanted = sky.light().wanted(sky.light().integrator().radiance(ray));
        for (std::size_t c = 0; c < 3; ++c) {
            EXPECT_NEAR(baked.image().texel(x, y)[c], wanted[c], 2e-3 * wanted[c]) << x << " " << y;
        }
    }
}

TEST(Environment, IsAlikeOnBothSidesOfTheSun) {
    const TestSky sky(test::preset_atmosphere("earth_hillaire"), SkyOrders::all);
    const Baked baked = bake(sky.light(), bake_of({32, 16}, 0.5, 5), Certification::quick);
    for (int y = 0; y < 16; ++y) {
        for (int x = 0; x < 32; ++x) {
            EXPECT_EQ(baked.image().texel(x, y)[0], baked.image().texel(31 - x, y)[0]);
        }
    }
    const auto row_of = [&](int x) { return baked.image().texel(x, 7)[0]; };
    EXPECT_GT(row_of(15), 2 * row_of(0)) << "the sun stands in the middle";
    EXPECT_LT(baked.certificate.texel.max, 5e-3);
    EXPECT_GT(baked.certificate.lookup.max, 0.05) << "lookups mix sky and ground at the horizon";
}

TEST(Environment, IsTheGroundBelowAndNothingAboveWithoutAir) {
    const SkyLight light(
        make_sky_medium(test::preset_atmosphere("vacuum", {"atmosphere.ground_albedo=0.5"})),
        SkyOrders::all, nullptr);
    const Baked baked = bake(light, bake_of({4, 4}, 0, 30));
    EXPECT_EQ(baked.image().texel(1, 0)[0], 0);
    EXPECT_EQ(baked.image().texel(1, 1)[0], 0);
    EXPECT_NEAR(baked.image().texel(1, 2)[0], 0.5 / std::numbers::pi * 0.5, 1e-7);
    EXPECT_NEAR(baked.image().texel(2, 3)[0], 0.5 / std::numbers::pi * 0.5, 1e-7);
}

TEST(Environment, TakesAnySizeCameraAndSun) {
    const TestSky sky(test::preset_atmosphere("earth_hillaire"), SkyOrders::all);
    for (const std::array<int, 2> size : {std::array<int, 2>{1, 1}, {2, 2}, {3, 5}, {1, 64}}) {
        for (const double altitude : {0.0, 1e-3, 100.0, 100.0001, 1000.0, 1e6}) {
            for (const double sun : {90.0, 0.0, -6.0, -90.0}) {
                const Baked baked = bake(sky.light(), bake_of(size, altitude, sun));
                for (const float texel : baked.image().texels) {
                    EXPECT_TRUE(std::isfinite(texel) && texel >= 0) << altitude;
                }
                // From space there is nothing above the air.
                if (altitude <= 100 || size[1] < 64) continue;
                EXPECT_EQ(baked.image().texel(0, 0)[2], 0);
            }
        }
    }
}

}  // namespace
}  // namespace skybake
