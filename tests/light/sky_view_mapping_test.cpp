#include "bakers/light/sky_view_mapping.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "bakers/field/image.h"
#include "bakers/light/sky_ray.h"
#include "tests/light/sky_media.h"

namespace skybake {
namespace {

using namespace test;

constexpr Shell kEarth = {6360, 100};

TEST(SkyViewMapping, HasTheRangesOfTheHorizon) {
    const SkyViewCamera ground(kEarth, 0);
    EXPECT_EQ(ground.dip(), 0);
    EXPECT_DOUBLE_EQ(ground.range_above(), 90 * kDegree);
    EXPECT_DOUBLE_EQ(ground.range_below(), 90 * kDegree);
    const SkyViewCamera tower(kEarth, 1);
    EXPECT_NEAR(tower.dip(), std::acos(6360.0 / 6361.0), 1e-12);
    EXPECT_NEAR(tower.range_above(), 90 * kDegree + tower.dip(), 1e-15);
    const SkyViewCamera space(kEarth, 36000);
    EXPECT_NEAR(space.range_below(), std::asin(6360.0 / 42360.0), 1e-12);
    EXPECT_NEAR(space.range_below() + space.range_above(), std::asin(6460.0 / 42360.0), 1e-12);
    // A camera a metre up: no digits are lost.
    EXPECT_NEAR(SkyViewCamera(kEarth, 0.001).dip() / std::sqrt(2 * 0.001 / 6360), 1, 1e-7);
}

RC_GTEST_PROP(SkyViewMapping, IsAnInversePair, ()) {
    const Shell shell = {log_uniform(10, 1e6), log_uniform(0.1, 1e5)};
    const SkyViewCamera camera(
        shell, shell.thickness_km *
                   (*rc::gen::inRange(0, 2) == 0 ? uniform(0, 1) : log_uniform(1e-6, 1e3)));
    const double y = uniform(0, 1);
    RC_ASSERT(std::fabs(camera.coordinate(camera.angle_at(y)) - y) < 1e-12);
    RC_ASSERT(camera.coordinate(camera.angle_at(0)) == 0);
    RC_ASSERT(camera.coordinate(camera.angle_at(0.5)) == 0.5);
    RC_ASSERT(std::fabs(camera.coordinate(camera.angle_at(1)) - 1) < 1e-15);
}

// Two ways to the same ray, one told by the horizon and one by the zenith.
RC_GTEST_PROP(SkyViewMapping, RaysAreThoseOfTheCamera, ()) {
    const Shell shell = {log_uniform(50, 1e5), log_uniform(1, 20)};
    const double altitude =
        shell.thickness_km * (*rc::gen::inRange(0, 2) == 0 ? uniform(0, 1) : uniform(1, 100));
    const SkyViewCamera camera(shell, altitude);
    const double half = *rc::gen::inRange(0, 2) == 0 ? 0 : 0.5;
    const double y = half + uniform(0.03, 0.47);
    const SunZenith sun = sun_at_elevation(uniform(-90, 90) * kDegree);
    const double azimuth_cosine = uniform(-1, 1);
    const double elevation = camera.angle_at(y) - camera.dip();
    const SkyDirection direction =
        sky_direction(sun, sine_of(elevation), cosine_of(elevation), azimuth_cosine);
    const SkyRay ray = camera.ray(y, sun, azimuth_cosine);
    const SkyRay other = camera_ray(shell, altitude, sun, direction).in_air;
    const double scale = shell.ground_radius_km + altitude;
    RC_ASSERT(ray.meets_ground == other.meets_ground);
    RC_ASSERT(ray.meets_ground == (half == 0));
    RC_ASSERT(std::fabs(ray.altitude_km - other.altitude_km) < 1e-9 * scale);
    RC_ASSERT(std::fabs(ray.s_km - other.s_km) < 1e-9 * scale);
    RC_ASSERT(std::fabs(ray.length_km - other.length_km) < 1e-8 * scale);
    RC_ASSERT(std::fabs(ray.sun_s_km - other.sun_s_km) < 1e-9 * scale);
    RC_ASSERT(ray.cosine_to_sun == other.cosine_to_sun);
}

TEST(SkyViewMapping, RaysAtTheEdgesAreWhatTheyAreCalled) {
    const SunZenith sun = sun_at_elevation(30 * kDegree);
    for (const double altitude : {0.0, 1e-4, 0.5, 99.999, 100.0, 100.001, 400.0, 4e5}) {
        const SkyViewCamera camera(kEarth, altitude);
        const SkyRay down = camera.ray(0, sun, 1);
        EXPECT_TRUE(down.meets_ground) << altitude;
        EXPECT_NEAR(down.length_km, std::min(altitude, 100.0), 1e-9) << altitude;
        // The horizon itself is the sky's: to the ground from there and up again.
        const SkyRay horizon = camera.ray(0.5, sun, 1);
        EXPECT_FALSE(horizon.meets_ground);
        const double to_ground = horizon_distance_km(kEarth, std::min(altitude, 100.0));
        EXPECT_NEAR(horizon.length_km, to_ground + horizon_distance_km(kEarth, 100), 1e-3);
        const SkyRay up = camera.ray(1, sun, 1);
        EXPECT_FALSE(up.meets_ground);
        EXPECT_NEAR(up.length_km, altitude < 100 ? 100 - altitude : 0, 1e-2) << altitude;
    }
}

TEST(SkyViewMapping, SkyAndGroundDoNotMixAtTheHorizon) {
    for (const int rows : {1, 2, 3, 4, 107, 108}) {
        const int first_of_sky = rows / 2;
        for (int i = 0; i < rows; ++i) {
            const double y =
                texel_coordinate(TexelConvention::end_points_on_texel_centres, i, rows);
            EXPECT_EQ(SkyViewCamera::meets_ground(y), i < first_of_sky) << i << " of " << rows;
            EXPECT_NEAR(sky_view_v(y, rows), (i + 0.5) / rows, 1e-15);
        }
        for (double y = 0; y <= 1; y += 1.0 / 256) {
            const double row = sky_view_v(y, rows) * rows - 0.5;
            EXPECT_GE(row, -1e-12);
            EXPECT_LE(row, rows - 1 + 1e-12);
            if (rows == 1) continue;
            if (y < 0.5) {
                EXPECT_LE(row, first_of_sky - 1 + 1e-12) << y << ' ' << rows;
            } else {
                EXPECT_GE(row, first_of_sky - 1e-12) << y << ' ' << rows;
            }
        }
    }
}

TEST(SunAtElevation, IsExactWhereItMatters) {
    EXPECT_EQ(sun_at_elevation(0).cosine, 0);
    EXPECT_EQ(sun_at_elevation(std::numbers::pi / 2).cosine, 1);
    EXPECT_EQ(sun_at_elevation(std::numbers::pi / 2).sine, 0);
    EXPECT_EQ(sun_at_elevation(-std::numbers::pi / 2).cosine, -1);
    EXPECT_NEAR(sun_at_elevation(30 * kDegree).cosine, 0.5, 1e-15);
}

}  // namespace
}  // namespace skybake
