// Several layers of clouds around a camera.
#include <gtest/gtest.h>

#include <algorithm>
#include <utility>

#include "bakers/assets/cloud_light/march_light.h"
#include "bakers/assets/environment/environment_clouds.h"
#include "bakers/assets/environment/environment_sun.h"
#include "bakers/assets/environment/environment_table.h"
#include "bakers/field/baked.h"
#include "tests/environment/maps.h"
#include "tests/light/sky_media.h"
#include "tests/preview/clouds.h"
#include "tests/support/scene_reference.h"

namespace skybake {
namespace {

using config::EnvironmentBake;
using namespace test;

CloudMedium slab(double base_m, double height_m, double optical_depth) {
    return medium_of({4000, 4000, height_m}, base_m, {8, 8, 32},
                     std::vector<float>(8 * 8 * 32, 1.0F), optical_depth / height_m);
}

// From the highest down: one far above, and two that overlap in altitude and have steps of one length.
std::vector<CloudMedium> three_layers() {
    const auto clumps = [](const std::array<double, 3>& extent_m, double base_m,
                           const std::array<int, 3>& size, std::uint32_t seed) {
        return medium_of(extent_m, base_m, size, test::clumped_voxels(size, seed, 0.4));
    };
    std::vector<CloudMedium> media;
    media.push_back(clumps({2000, 1500, 300}, 2500, {20, 30, 8}, 5));
    media.push_back(clumps({700, 1100, 500}, 800, {14, 22, 10}, 4));
    media.push_back(clumps({1200, 900, 600}, 500, {24, 18, 12}, 3));
    return media;
}

// The slow march in double through all layers at once, with the sun to the left.
TEST(EnvironmentLayers, AreTheMeansOfSlowMarches) {
    const std::vector<CloudMedium> media = three_layers();
    EnvironmentBake bake = map_bake({48, 24}, 35);
    bake.sun_azimuth = {-70 * kDegree};
    bake.camera_x = {130};
    bake.camera_y = {420};
    bake.altitude = {100};
    bake.samples = 8;
    const EnvironmentLayout layout(bake.mapping, bake.size);
    const CloudsAround clouds(media, bake, layout, true, {.threads = 1});
    std::vector<SceneLayer> layers;
    std::vector<LightInCloud> lights;
    for (const CloudMedium& medium : media) {
        const cloud_light::MarchLight within(medium, cloud_light::kCellsOfPicture, {.threads = 1});
        lights.push_back(*within.under({35, 70}, {.threads = 1}));
    }
    for (std::size_t l = 0; l < media.size(); ++l) {
        const MarchSteps steps = usual_steps(media[l], {35, 70});
        layers.push_back(
            {&media[l], steps.step_m, steps.light_step_m, steps.reach_m, 1, &lights[l]});
    }
    CloudCamera camera;
    camera.position_m = {130, 420, 100};
    constexpr int kEdge = 4;
    int cloudy = 0;
    for (const auto& [column, row] : {std::pair{5, 4}, {24, 6}, {33, 3}, {45, 8}}) {
        std::vector<ReferenceLayer> sums(3);
        double transmittance = 0;
        double weights = 0;
        for (int k = 0; k < kEdge * kEdge; ++k) {
            const double azimuth = 2 * kPi * ((column + (k % kEdge + 0.5) / kEdge) / 48 - 0.5);
            const double elevation = kPi * (0.5 - (row + (k / kEdge + 0.5) / kEdge) / 24);
            const double weight = std::cos(elevation);
            const glm::dvec3 direction(weight * std::cos(azimuth), -weight * std::sin(azimuth),
                                       std::sin(elevation));
            const ReferenceScene ray = reference_scene(layers, {35, 70}, camera, direction, 300);
            for (std::size_t l = 0; l < 3; ++l) {
                sums[l].sun_at_base += weight * ray.layers[l].sun_at_base;
                sums[l].sun_at_top += weight * ray.layers[l].sun_at_top;
                sums[l].from_sky += weight * ray.layers[l].from_sky;
                sums[l].from_ground += weight * ray.layers[l].from_ground;
                sums[l].opacity += weight * ray.layers[l].opacity;
                sums[l].distance_m += weight * ray.layers[l].distance_m;
            }
            transmittance += weight * ray.transmittance;
            weights += weight;
        }
        const SeenClouds seen = clouds.texel(0, column, row);
        EXPECT_NEAR(seen.transmittance, transmittance / weights, 0.03);
        ASSERT_EQ(seen.layers.size(), 3u);
        for (std::size_t l = 0; l < 3; ++l) {
            const SeenLayer& found = seen.layers[l];
            const auto near = [&](double value, double sum) {
                EXPECT_NEAR(value, sum / weights, 0.02 + 0.1 * sum / weights) << l;
            };
            near(found.sun_at_base, sums[l].sun_at_base);
            near(found.sun_at_top, sums[l].sun_at_top);
            near(found.from_sky, sums[l].from_sky);
            near(found.from_ground, sums[l].from_ground);
            near(found.opacity, sums[l].opacity);
            EXPECT_NEAR(found.distance_m, sums[l].distance_m / weights,
                        40 + 0.1 * sums[l].distance_m / weights);
            if (found.opacity > 0.1) ++cloudy;
        }
    }
    EXPECT_GT(cloudy, 5);
}

TEST(EnvironmentLayers, OrderOfTheListDoesNotMatter) {
    std::vector<CloudMedium> media = three_layers();
    EnvironmentBake bake = map_bake({32, 16}, 20);
    bake.samples = 1;
    const Image2<float> first = baked(bake, media).image();
    std::rotate(media.begin(), media.begin() + 1, media.end());
    EXPECT_LT(greatest_difference(first, baked(bake, media).image()), 1e-6);
    std::swap(media[0], media[1]);
    EXPECT_LT(greatest_difference(first, baked(bake, media).image()), 1e-6);
    media.pop_back();
    EXPECT_GT(greatest_difference(first, baked(bake, media).image()), 1e-3);
}

TEST(EnvironmentLayers, AnEmptyLayerChangesNothing) {
    const std::vector<CloudMedium> media = three_layers();
    EnvironmentBake bake = map_bake({32, 16}, 20);
    bake.samples = 1;
    const std::vector<CloudMedium> alone = {media[2]};
    const std::vector<CloudMedium> both = {
        medium_of({900, 900, 400}, 700, {3, 3, 3}, std::vector<float>(27, 0.0F), 0.01), media[2]};
    EXPECT_LT(greatest_difference(baked(bake, alone).image(), baked(bake, both).image()), 1e-6);
}

// The depths of slabs add up, before the camera and before the sun's disc, however thick they are.
TEST(EnvironmentLayers, TransmitTheProductOfTheirTransmittances) {
    const std::vector<CloudMedium> media = {slab(1000, 500, 3), slab(3000, 800, 20),
                                            slab(1200, 600, 1.5)};
    const EnvironmentBake bake = map_bake({4, 2}, 90);
    const EnvironmentLayout layout(bake.mapping, bake.size);
    const CloudsAround clouds(media, bake, layout, true, {.threads = 1});
    for (const double elevation : {90.0, 40.0}) {
        const double depth = 24.5 / std::sin(elevation * kDegree);
        const double found = clouds.transmittance(direction_of_angles({0.4, elevation * kDegree}));
        EXPECT_NEAR(-std::log(found) / depth, 1, 0.04) << elevation;
    }
    const auto disc = [&](const CloudsAround* around) {
        return irradiance_of(sun_points(earth().light(), bake, around), LitSurface::facing_sun,
                             3)[1];
    };
    EXPECT_NEAR(std::log(disc(nullptr) / disc(&clouds)), 24.5, 0.5);
}

// Long after sunset a cloud below an overcast has the light of the sky that passes it, which two-stream
// theory gives as 2 / (2 + (1 - g) tau). The camera is close above it and looks straight down.
TEST(EnvironmentLayers, AboveDimTheSkyOfThoseBelow) {
    const CloudMedium low = slab(500, 500, 60);
    EnvironmentBake bake = map_bake({1, 64}, -8);
    bake.altitude = {1010};
    const double g = mean_cosine(droplet_phase(kDropletDiameter_um));
    const auto seen_below = [&](const std::vector<CloudMedium>& media) {
        return double{baked(bake, media).image().texel(0, 63)[1]};
    };
    const double open = seen_below({low});
    EXPECT_GT(open, 0);
    for (const double tau : {4.0, 12.0}) {
        const double passes = 2 / (2 + (1 - g) * tau);
        EXPECT_NEAR(seen_below({slab(3000, 500, tau), low}) / open, passes, 0.02) << tau;
        EXPECT_NEAR(seen_below({low, slab(3000, 500, tau)}) / open, passes, 0.02) << tau;
    }
}

}  // namespace
}  // namespace skybake
