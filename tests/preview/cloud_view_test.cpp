#include "bakers/render/cloud_view.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>

#include "bakers/render/cloud_camera.h"
#include "tests/preview/cloud_views.h"
#include "tests/preview/skies.h"

namespace skybake {
namespace {

using namespace test;

struct Scene {
    CloudMedium medium;
    MarchSettings settings;
};

Scene any_scene() {
    const std::array<int, 3> size = {any_count(1, 40), any_count(1, 40),
                                     *rc::gen::element(1, 2, 7, 16, 21)};
    config::Cloud cloud =
        cloud_of({any_number(100, 2000), any_number(100, 2000), any_number(50, 1000)},
                 *rc::gen::element(0.0, 700.0));
    cloud.extinction_scale.per_meter = *rc::gen::element(0.0, 0.002, 0.005, 0.05, 1e6);
    if (*rc::gen::arbitrary<bool>()) {
        cloud.threshold_at = config::ThresholdAt::runtime;
        cloud.threshold = *rc::gen::element(0.0, 0.25, 0.5, 2.0);
        cloud.edge_softness = *rc::gen::element(0.0, 0.05);
    }
    const auto voxels = clumped_voxels(size, static_cast<std::uint32_t>(any_count(0, 1 << 20)),
                                       *rc::gen::element(0.0, 0.02, 0.05, 0.1, 0.3, 1.0));
    Scene scene;
    scene.medium = medium_of(cloud, size, voxels, *rc::gen::element(1, 2, 4, 8, 16));
    const SunDirection sun = {*rc::gen::element(-90.0, -5.0, 0.0, 0.3, 12.0, 20.0, 45.0, 90.0),
                              *rc::gen::element(0.0, 45.0, 90.0, 137.0, 270.0)};
    scene.settings = small_view(scene.medium, sun);
    CloudCamera& camera = scene.settings.camera;
    const bool below = *rc::gen::arbitrary<bool>();
    const double height = below ? any_number(-0.5, 0.9) : any_number(0.1, 1.5);  // of the layer
    camera.position_m = {any_number(-3000, 3000), any_number(-3000, 3000),
                         cloud.base_altitude.meters + height * cloud.extent[2].meters};
    camera.azimuth_degrees = *rc::gen::element(0.0, 45.0, 90.0, 180.0, 201.0);
    camera.elevation_degrees = (below ? 1 : -1) * *rc::gen::element(0.0, 10.0, 45.0, 90.0);
    return scene;
}

RC_GTEST_PROP(CloudView, LeapingChangesNoBit, ()) {
    for (int i = 0; i < 8; ++i) {
        Scene scene = any_scene();
        const MarchedScene leaping = march_view(scene.medium, scene.settings, 1);
        scene.settings.leaping = false;
        const MarchedScene straight = march_view(scene.medium, scene.settings, 1);
        RC_ASSERT(same_bits(leaping.results, straight.results));
        RC_ASSERT(leaping.fetches.samples <= straight.fetches.samples);
        RC_ASSERT(leaping.fetches.light_samples <= straight.fetches.light_samples);
        for (const float value : straight.results.texels) RC_ASSERT(std::isfinite(value));
    }
}

TEST(CloudView, LeapsSaveFetches) {
    const std::array<int, 3> size = {48, 48, 24};
    const CloudMedium medium =
        medium_of(cloud_of({2000, 2000, 800}, 600), size, clumped_voxels(size, 5, 0.02));
    MarchSettings settings = small_view(medium, {30, 100});
    const FetchCounts leaping = march_view(medium, settings, 1).fetches;
    settings.leaping = false;
    const FetchCounts straight = march_view(medium, settings, 1).fetches;
    EXPECT_LT(3 * leaping.samples, straight.samples);
    EXPECT_LT(2 * leaping.light_samples, straight.light_samples);
    EXPECT_GT(leaping.cells, 0);
    EXPECT_EQ(straight.cells, 0);
}

// Under a white sky and above white ground nothing is brighter than they are.
RC_GTEST_PROP(CloudView, GivesNoMoreThanAWhiteFurnace, ()) {
    const Scene scene = any_scene();
    const Image2<float> view = march_view(scene.medium, scene.settings, 1).results;
    for (std::size_t i = 0; i < view.texels.size(); i += static_cast<std::size_t>(view.channels)) {
        const float* seen = &view.texels[i];
        RC_ASSERT(seen[kTransmittance] >= 0.0F);
        RC_ASSERT(seen[kTransmittance] <= 1.0F);
        RC_ASSERT(seen[kFromSky] + seen[kFromGround] + seen[kTransmittance] <= 1.0F + 1e-5F);
    }
}

TEST(CloudView, ShowsSkyWhereThereIsNoCloud) {
    static const test::Sky sky = test::sky_of("earth_hillaire");
    const std::array<int, 3> size = {16, 16, 4};
    const CloudMedium empty =
        medium_of(cloud_of({1000, 1000, 500}, 800), size, std::vector<float>(1024));
    const CloudMedium full =
        medium_of(cloud_of({1000, 1000, 500}, 800), size, std::vector<float>(1024, 1.0F));
    for (const double elevation : {90.0, 20.0, 0.0, -2.0, -90.0}) {
        MarchSettings settings = small_view(empty, {elevation, 90});
        const Atmosphere air{sky.medium, sky.tables};
        const Image2<float> sky_alone = render_cloud(empty, air, settings, 1);
        const Image2<float> overcast = render_cloud(full, air, settings, 2);
        double brightest = 0;
        for (const Image2<float>* image : {&sky_alone, &overcast}) {
            for (const float value : image->texels) {
                ASSERT_TRUE(std::isfinite(value)) << elevation;
                ASSERT_GE(value, 0.0F) << elevation;
                brightest = std::max(brightest, double{value});
            }
        }
        EXPECT_LT(brightest, 2.0) << elevation;  // per unit of solar irradiance, no sun in view
        EXPECT_EQ(same_bits(sky_alone, overcast), elevation == -90) << elevation;
    }
}

}  // namespace
}  // namespace skybake
