#include "bakers/plan/cloud_truth.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

namespace skybake {
namespace {

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
