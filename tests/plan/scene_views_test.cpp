#include "bakers/plan/light_truth.h"

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
    for (const LightView& view : scene_views(config::Draws::sky, range, kEarth, 256, 1)) {
        EXPECT_GE(view.sky.altitude_km, 0.5);
        EXPECT_LE(view.sky.altitude_km, 3);
        EXPECT_GE(view.sky.sun_elevation_deg, -4);
        EXPECT_LE(view.sky.sun_elevation_deg, 40);
        EXPECT_GT(view.sky.above_horizon_deg, 0);
        EXPECT_LT(view.sky.above_horizon_deg, 95);
        EXPECT_GE(view.sky.azimuth_deg, 0);
        EXPECT_LE(view.sky.azimuth_deg, 180);
    }
}

// A quarter of the views has the lowest quarter of the suns, and so on: it is the pictures' decile.
TEST(SceneViews, AreEvenInTheSun) {
    const auto views =
        scene_views(config::Draws::sky, range_of(scene(0, 80), kEarth), kEarth, 256, 256);
    for (const double bound : {20., 40., 60.}) {
        const auto below = std::count_if(views.begin(), views.end(), [&](const LightView& view) {
            return view.sky.sun_elevation_deg < bound;
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
    const auto views = scene_views(config::Draws::sky, range_of(own, kEarth), kEarth, 64, 1);
    const auto high = std::count_if(views.begin(), views.end(), [](const LightView& view) {
        return std::fabs(view.sky.sun_elevation_deg - 30) < 1e-9;
    });
    EXPECT_EQ(high, 32);
    for (const LightView& view : views) {
        EXPECT_TRUE(std::fabs(view.sky.sun_elevation_deg - 30) < 1e-9 ||
                    std::fabs(view.sky.sun_elevation_deg + 2) < 1e-9);
    }
}

TEST(SceneViews, OfAnotherPartDiffer) {
    const SceneRange range = range_of(scene(-4, 40), kEarth);
    const auto first = scene_views(config::Draws::sky, range, kEarth, 64, 1);
    const auto second = scene_views(config::Draws::sky, range, kEarth, 64, 4096);
    for (const LightView& a : first) {
        for (const LightView& b : second) {
            EXPECT_FALSE(a.sky.sun_elevation_deg == b.sky.sun_elevation_deg &&
                         a.sky.azimuth_deg == b.sky.azimuth_deg);
        }
    }
}

TEST(SceneViews, OfThingsEndAtTheGroundOrTheViewDistance) {
    config::Scene own = scene(0, 80);
    own.view_distance = {40e3};
    const auto views = scene_views(config::Draws::distance, range_of(own, kEarth), kEarth, 256, 1);
    int grounded = 0;
    for (const LightView& view : views) {
        const double elevation = elevation_deg(kEarth, view.sky);
        EXPECT_LE(std::fabs(elevation), kMostTilt_deg + 1e-9);
        EXPECT_GT(view.distance_km, 0);
        EXPECT_LT(view.distance_km, 40);
        // Half a degree below the horizontal the ground's curvature counts; from 3 degrees on it does not.
        if (elevation > -3) continue;
        ++grounded;
        const double flat_km = view.sky.altitude_km / std::sin(-elevation * std::numbers::pi / 180);
        EXPECT_LT(view.distance_km, flat_km * 1.02);
    }
    EXPECT_GT(grounded, 100);
}

// Each half of the sphere has half of the directions, and its middle half as many as its ends.
TEST(SceneViews, OfSurroundingsAreEvenOnTheSphere) {
    const auto views = scene_views(config::Draws::surroundings, range_of(scene(0, 80), kEarth),
                                   kEarth, 1024, 1024);
    for (const double sine : {-0.5, 0.0, 0.5}) {
        const auto below = std::ranges::count_if(views, [&](const LightView& view) {
            return std::sin(elevation_deg(kEarth, view.sky) * std::numbers::pi / 180) < sine;
        });
        EXPECT_NEAR(static_cast<double>(below), 1024 * (sine + 1) / 2, 2);
    }
}

// A camera in space sees the sky from the top of the air.
TEST(SceneViews, HaveCamerasInTheAir) {
    config::Scene own = scene(0, 80);
    own.altitude = {config::Length{200e3}, config::Length{400e3}};
    for (const LightView& view :
         scene_views(config::Draws::sky, range_of(own, kEarth), kEarth, 16, 1)) {
        EXPECT_LT(view.sky.altitude_km, 100);
    }
}

}  // namespace
}  // namespace skybake
