#include "bakers/plan/sky_truth.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace skybake {
namespace {

constexpr Shell kEarth{6371, 100};

config::Angle degrees(double angle) { return {angle * std::numbers::pi / 180}; }

config::Scene scene(double lowest_sun, double highest_sun) {
    config::Scene result;
    result.altitude = {config::Length{500}, config::Length{3000}};
    result.sun_elevation = {degrees(lowest_sun), degrees(highest_sun)};
    return result;
}

TEST(SceneViews, LieWithinTheSceneAndAboveTheHorizon) {
    const SceneRange range = range_of(scene(-4, 40), kEarth);
    for (const SkySample& view : scene_views(range, kEarth, 256, 1)) {
        EXPECT_GE(view.altitude_km, 0.5);
        EXPECT_LE(view.altitude_km, 3);
        EXPECT_GE(view.sun_elevation_deg, -4);
        EXPECT_LE(view.sun_elevation_deg, 40);
        EXPECT_GT(view.above_horizon_deg, 0);
        EXPECT_LT(view.above_horizon_deg, 95);
        EXPECT_GE(view.azimuth_deg, 0);
        EXPECT_LE(view.azimuth_deg, 180);
    }
}

// A quarter of the views has the lowest quarter of the suns, and so on: it is the pictures' decile.
TEST(SceneViews, AreEvenInTheSun) {
    const auto views = scene_views(range_of(scene(0, 80), kEarth), kEarth, 256, 256);
    for (const double bound : {20., 40., 60.}) {
        const auto below = std::count_if(views.begin(), views.end(), [&](const SkySample& view) {
            return view.sun_elevation_deg < bound;
        });
        EXPECT_EQ(below, 256 * bound / 80);
    }
}

TEST(SceneViews, LeaveNightsOutUnlessThereIsNothingElse) {
    EXPECT_EQ(range_of(scene(-90, 90), kEarth).lowest_sun_deg, kLowestSun_deg);
    EXPECT_NEAR(range_of(scene(-20, -10), kEarth).lowest_sun_deg, -20, 1e-9);
}

TEST(SceneViews, HaveTheOnlySunsThatAreGiven) {
    config::Scene own = scene(-90, 90);
    own.suns = {degrees(30), degrees(-2)};
    const auto views = scene_views(range_of(own, kEarth), kEarth, 64, 1);
    const auto high = std::count_if(views.begin(), views.end(), [](const SkySample& view) {
        return std::fabs(view.sun_elevation_deg - 30) < 1e-9;
    });
    EXPECT_EQ(high, 32);
    for (const SkySample& view : views) {
        EXPECT_TRUE(std::fabs(view.sun_elevation_deg - 30) < 1e-9 ||
                    std::fabs(view.sun_elevation_deg + 2) < 1e-9);
    }
}

TEST(SceneViews, OfAnotherPartDiffer) {
    const SceneRange range = range_of(scene(-4, 40), kEarth);
    const auto first = scene_views(range, kEarth, 64, 1);
    const auto second = scene_views(range, kEarth, 64, 4096);
    for (const SkySample& a : first) {
        for (const SkySample& b : second) {
            EXPECT_FALSE(a.sun_elevation_deg == b.sun_elevation_deg &&
                         a.azimuth_deg == b.azimuth_deg);
        }
    }
}

// A camera in space sees the sky from the top of the air.
TEST(SceneViews, HaveCamerasInTheAir) {
    config::Scene own = scene(0, 80);
    own.altitude = {config::Length{200e3}, config::Length{400e3}};
    for (const SkySample& view : scene_views(range_of(own, kEarth), kEarth, 16, 1)) {
        EXPECT_LT(view.altitude_km, 100);
    }
}

}  // namespace
}  // namespace skybake
