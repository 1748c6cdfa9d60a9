#include "bakers/render/cloud_framing.h"
#include "bakers/render/cloud_camera.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/preview/clouds.h"
#include "tests/support/cloud_marches.h"
#include "tests/support/volumes.h"

namespace skybake {
namespace {

constexpr std::array<int, 3> kSize = {32, 24, 16};

std::size_t index_of(int x, int y, int z) {
    return static_cast<std::size_t>((z * kSize[1] + y) * kSize[0] + x);
}

// Voxels 8 ... 11, 6 ... 9 and 4 ... 7 and a faint crumb, of a tile of 3.2 x 2.4 x 1.6 km.
CloudMedium tower(double base_m, bool repeats) {
    std::vector<float> voxels(index_of(0, 0, kSize[2]));
    for (int z = 4; z < 8; ++z) {
        for (int y = 6; y < 10; ++y) {
            for (int x = 8; x < 12; ++x) voxels[index_of(x, y, z)] = 0.5F;
        }
    }
    voxels[index_of(30, 2, 12)] = 0.02F;  // a crumb
    return cloud_medium(test::cloud_of({3200, 2400, 1600}, base_m), voxels.data(), kSize, 1, 1,
                        repeats);
}

TEST(CloudFraming, KnowsWhereThereIsSomething) {
    const CloudBox box = occupied_box(tower(1000, false));
    EXPECT_EQ(box.low_m, (glm::dvec3{800, 600, 1400}));
    EXPECT_EQ(box.high_m, (glm::dvec3{1200, 1000, 1800}));
    const std::vector<float> nothing(index_of(0, 0, kSize[2]));
    const CloudBox whole = occupied_box(
        cloud_medium(test::cloud_of({3200, 2400, 1600}, 500), nothing.data(), kSize, 1, 1, false));
    EXPECT_EQ(whole.low_m, (glm::dvec3{0, 0, 500}));
    EXPECT_EQ(whole.high_m, (glm::dvec3{3200, 2400, 2100}));
}

// A corner of the box in the picture, from -1 to 1 along both edges, by the rays' own directions.
std::array<double, 2> place_in_picture(const CloudViewSettings& settings, const glm::dvec3& point) {
    const CameraRays rays(settings.camera, settings.width, settings.height);
    const glm::dvec3 left = rays.through(-0.5, 0.5 * settings.height - 0.5);
    const glm::dvec3 right = rays.through(settings.width - 0.5, 0.5 * settings.height - 0.5);
    const glm::dvec3 top = rays.through(0.5 * settings.width - 0.5, -0.5);
    const glm::dvec3 bottom = rays.through(0.5 * settings.width - 0.5, settings.height - 0.5);
    const auto share = [&](const glm::dvec3& low, const glm::dvec3& high) {
        glm::dvec3 across;
        glm::dvec3 along;
        for (std::size_t a = 0; a < 3; ++a) {
            across[a] = high[a] - low[a];
            along[a] = high[a] + low[a];
        }
        const double half = std::sqrt(glm::dot(across, across) / glm::dot(along, along));
        return glm::dot(point, across) / std::sqrt(glm::dot(across, across)) /
               (half * glm::dot(point, along) / std::sqrt(glm::dot(along, along)));
    };
    return {share(left, right), share(bottom, top)};
}

// From eye height the ground hides the distance behind its haze; who asks for it gets it.
TEST(CloudFraming, StandsOnAHillBelowALayer) {
    const CloudMedium layer = tower(500, true);
    EXPECT_EQ(framed_view(layer, {20, 105}, 96, 54).camera.position_m[2], 100);
    CameraRequest request;
    request.position_m = {0, 0, 2};
    EXPECT_EQ(framed_view(layer, {20, 105}, 96, 54, request).camera.position_m[2], 2);
}

double farthest_corner_in_picture(const CloudBox& box, const CloudViewSettings& settings) {
    double farthest = 0;
    for (int corner = 0; corner < 8; ++corner) {
        glm::dvec3 point;
        for (std::size_t a = 0; a < 3; ++a) {
            point[a] = ((corner >> a & 1) != 0 ? box.high_m[a] : box.low_m[a]) -
                       settings.camera.position_m[a];
        }
        for (const double share : place_in_picture(settings, point)) {
            farthest = std::max(farthest, std::fabs(share));
        }
    }
    return farthest;
}

// A layer ends close to the horizon of any camera, or after 256 tiles.
TEST(CloudFraming, ReachesTheHorizonFromAnyAltitude) {
    for (const double altitude_m : {100.0, 10e3, 20e3, 90e3}) {
        CameraRequest request;
        request.position_m = {0, 0, altitude_m};
        const auto settings = framed_view(tower(1000, true), {40, 0}, 64, 36, request);
        const double ends_below = std::fabs(altitude_m - 1800) / settings.reach_m;
        const bool all_tiles = settings.reach_m == 256 * 3200.0;
        EXPECT_TRUE(all_tiles || ends_below < std::sin(1.51 / 57.2957795)) << altitude_m;
        EXPECT_EQ(all_tiles, altitude_m == 90e3);
    }
}

TEST(CloudFraming, HasAllOfASingleTileInThePictureAndMostOfThePictureFilled) {
    for (const double base_m : {0.0, 3000.0}) {
        const CloudMedium medium = tower(base_m, false);
        const CloudBox box = occupied_box(medium);
        for (const std::array<int, 2>& size : {std::array{96, 54}, std::array{40, 80}}) {
            for (const double heading : {0.0, 63.0, 200.0}) {
                CameraRequest request;
                request.heading_degrees = heading;
                request.field_degrees = 30;
                const CloudViewSettings settings =
                    framed_view(medium, {20, 105}, size[0], size[1], request);
                EXPECT_GE(settings.camera.position_m[2], 100) << "above the haze of the ground";
                const double farthest = farthest_corner_in_picture(box, settings);
                EXPECT_LT(farthest, 0.91) << base_m << ' ' << heading;
                EXPECT_GT(farthest, 0.85) << base_m << ' ' << heading;
            }
        }
    }
}

// All views have the whole cloud, look at its axis, and lie on one circle in equal steps.
TEST(CloudFraming, TurnsAroundASingleTile) {
    constexpr int count = 12;
    for (const double base_m : {0.0, 3000.0}) {
        const CloudMedium medium = tower(base_m, false);
        const CloudBox box = occupied_box(medium);
        const glm::dvec3 middle = 0.5 * (box.low_m + box.high_m);
        const auto views = turntable_views(medium, {20, 105}, 96, 54, {}, count);
        ASSERT_EQ(views.size(), 12U);
        double nearest = 1;
        for (std::size_t i = 0; i < views.size(); ++i) {
            const CloudCamera& camera = views[i].camera;
            const double share = farthest_corner_in_picture(box, views[i]);
            EXPECT_LT(share, 0.91) << i;
            nearest = std::min(nearest, share);
            EXPECT_GE(camera.position_m.z, 100);
            EXPECT_EQ(camera.position_m.z, views[0].camera.position_m.z);
            EXPECT_EQ(camera.elevation_degrees, views[0].camera.elevation_degrees);
            EXPECT_NEAR(std::remainder(camera.azimuth_degrees - 63 - 30.0 * double(i), 360.0), 0,
                        1e-9);
            const glm::dvec3 ahead = direction_of(0, camera.azimuth_degrees);
            const glm::dvec3 back(camera.position_m.x - middle.x, camera.position_m.y - middle.y,
                                  0);
            const double distance = std::sqrt(glm::dot(back, back));
            EXPECT_NEAR(glm::dot(back, ahead), -distance, 1e-6 * distance) << i;
            EXPECT_GE(views[i].reach_m, distance);
        }
        EXPECT_GT(nearest, 0.5);
    }
}

TEST(CloudFraming, TurnsACameraThatHasAPosition) {
    CameraRequest request;
    request.position_m = {{1000, -4000, 30}};  // beside the axis at (1000, 800)
    request.heading_degrees = 80;
    const auto views = turntable_views(tower(900, false), {20, 105}, 96, 54, request, 4);
    EXPECT_EQ(views[0].camera.position_m, (glm::dvec3{1000, -4000, 30}));
    EXPECT_EQ(views[0].camera.azimuth_degrees, 80);
    EXPECT_NEAR(views[1].camera.position_m.x, 1000 + 4800, 1e-6);
    EXPECT_NEAR(views[1].camera.position_m.y, 800, 1e-6);
    EXPECT_EQ(views[1].camera.azimuth_degrees, 170);
}

TEST(CloudFraming, ObeysARequest) {
    CameraRequest request;
    request.position_m = {{10, 20, 30}};
    request.pitch_degrees = 7;
    for (const bool repeats : {true, false}) {
        const CloudCamera camera =
            framed_view(tower(900, repeats), {20, 105}, 96, 54, request).camera;
        EXPECT_EQ(camera.position_m, (glm::dvec3{10, 20, 30}));
        EXPECT_EQ(camera.elevation_degrees, 7);
        EXPECT_EQ(camera.azimuth_degrees, 63);
        EXPECT_EQ(camera_text(camera),
                  "position=0.01km,0.02km,0.03km heading=63deg pitch=7deg fov=50deg");
    }
}

// The same tower as the only one in a tile that is three times as long, which repeats: there is
// nothing else within reach.
TEST(CloudView, OfASingleTileIsThatOfALargeTileWithNothingElse) {
    const CloudMedium alone = tower(1000, false);
    const std::array<int, 3> size = {3 * kSize[0], 3 * kSize[1], kSize[2]};
    std::vector<float> voxels(9 * index_of(0, 0, kSize[2]));
    testing::for_each_voxel(kSize, [&](int x, int y, int z) {
        const float value = alone.volume.values[static_cast<std::size_t>(
            (z + 1) * alone.volume.plane() + (y + 1) * alone.volume.row() + x + 1)];
        voxels[static_cast<std::size_t>((z * size[1] + y + kSize[1]) * size[0] + x + kSize[0])] =
            value;
    });
    CloudMedium large =
        cloud_medium(test::cloud_of({9600, 7200, 1600}, 1000), voxels.data(), size, 1, 1);
    CloudMedium single = alone;
    single.leaps = leaps_of_voxels(single, 4, 1);
    large.leaps = leaps_of_voxels(large, 4, 1);
    CameraRequest request;
    request.position_m = {{-700, -1500, 1100}};
    MarchSettings settings = {framed_view(single, {25, 105}, 32, 18, request)};
    settings.reach_m = 5000;
    const Image2<float> one = march_view(single, settings, 1).results;
    settings.camera.position_m[0] += 3200;
    settings.camera.position_m[1] += 2400;
    const Image2<float> other = march_view(large, settings, 1).results;
    int seen = 0;
    for (std::size_t i = 0; i < one.texels.size(); ++i) {
        // Sunlight and transmittance; diffuse light comes from the layer's own mean.
        const auto channel = i % static_cast<std::size_t>(one.channels);
        if (channel == 2 || channel == 3) continue;
        EXPECT_NEAR(one.texels[i], other.texels[i], 2e-3 * std::fabs(other.texels[i]) + 1e-4) << i;
        if (channel == 6 && one.texels[i] < 0.9F) ++seen;
    }
    EXPECT_GT(seen, 5);
    // The layer that the same tile repeats to is another picture.
    CloudMedium layer = tower(1000, true);
    settings = {framed_view(single, {25, 105}, 32, 18, request)};
    settings.reach_m = 20000;
    int more = 0;
    const Image2<float> repeated = march_view(layer, settings, 1).results;
    for (std::size_t i = 6; i < one.texels.size(); i += static_cast<std::size_t>(one.channels)) {
        if (repeated.texels[i] < one.texels[i] - 0.1F) ++more;
    }
    EXPECT_GT(more, 5);
}

}  // namespace
}  // namespace skybake
