#include <gtest/gtest.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "bakers/plan/cloud_truth.h"
#include "bakers/plan/light_truth.h"

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

config::Cloud layer_at(double base_m, double height_m) {
    config::Cloud cloud;
    cloud.base_altitude = config::Length{base_m};
    cloud.extent = {config::Length{6000}, config::Length{6000}, config::Length{height_m}};
    return cloud;
}

config::Scene scene_of(double lowest_m, double highest_m) {
    config::Scene scene;
    scene.altitude = {config::Length{lowest_m}, config::Length{highest_m}};
    scene.sun_elevation = {config::Angle{-0.3}, config::Angle{0.7}};
    scene.view_distance = config::Length{20e3};
    return scene;
}

// From below, within and above: each ray crosses the layer within the view distance.
TEST(CloudViews, CrossTheLayer) {
    const CloudRange range = cloud_range(scene_of(0, 3000), layer_at(1000, 800));
    int ups = 0;
    int within = 0;
    const int count = 1024;
    for (const CloudView& view : cloud_views(range, count, 1)) {
        EXPECT_NEAR(glm::length(view.look), 1, 1e-12);
        EXPECT_GE(view.place.x, 0);
        EXPECT_LT(view.place.y, 1);
        const bool is_within = view.place.z > 0 && view.place.z < 1;
        within += is_within ? 1 : 0;
        ups += view.look.z > 0 ? 1 : 0;
        EXPECT_TRUE(is_within || (view.look.z > 0) == (view.place.z == 0));
        const double rise_m = 800 * (view.look.z > 0 ? 1 - view.place.z : view.place.z);
        EXPECT_LE(rise_m / std::fabs(view.look.z), 20e3 * (1 + 1e-9));
        EXPECT_LT(view.sun, range.suns_deg.size());
    }
    EXPECT_NEAR(within, count * 800.0 / 3000, 5);
    EXPECT_NEAR(ups, count * (1000 + 400) / 3000.0, 0.03 * count);
}

// The far face, and not the near one, is within the view distance, measured from the camera.
TEST(CloudViews, CameraBelowSeesTheTopWithinTheViewDistance) {
    const CloudRange range = cloud_range(scene_of(0, 0), layer_at(1000, 800));
    for (const CloudView& view : cloud_views(range, 256, 1)) {
        EXPECT_LE(1800 / view.look.z, 20e3 * (1 + 1e-9));
    }
}

TEST(CloudViews, SunsAreThoseOfTheSceneAboveTheHorizon) {
    config::Scene scene = scene_of(0, 100);
    const CloudRange any = cloud_range(scene, layer_at(1000, 800));
    EXPECT_FALSE(any.has_own_suns);
    ASSERT_EQ(any.suns_deg.size(), 3u);
    EXPECT_NEAR(any.suns_deg[0], 10, 1e-12);
    EXPECT_NEAR(any.suns_deg[1], 30, 1e-12);
    EXPECT_NEAR(any.suns_deg[2], 0.7 * 180 / M_PI, 1e-9) << "the highest sun is below 60 degrees";
    scene.suns = {config::Angle{-0.1}, config::Angle{0.5}};
    const CloudRange own = cloud_range(scene, layer_at(1000, 800));
    EXPECT_TRUE(own.has_own_suns);
    ASSERT_EQ(own.suns_deg.size(), 1u);
    scene.suns = {};
    scene.sun_elevation = {config::Angle{-0.3}, config::Angle{-0.1}};
    EXPECT_TRUE(cloud_range(scene, layer_at(1000, 800)).suns_deg.empty());
}

}  // namespace

}  // namespace skybake
