// Shadows of clouds on the ground, of a tile that stands alone and of a layer that repeats.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "bakers/preview/pictures/cloud_pictures.h"
#include "bakers/render/scene_view.h"
#include "tests/preview/scenes.h"
#include "tests/support/loops.h"

namespace skybake {
namespace {

using test::picture_of;

constexpr double kExtinction = 0.01;  // 1/m

// A tile of 1600 x 1600 x 400 m at an altitude of 1 km, which is cloud throughout.
CloudMedium slab(bool repeats) {
    return test::medium_of({1600, 1600, 400}, 1000, {32, 32, 8},
                           std::vector<float>(32 * 32 * 8, 1.0F), kExtinction, 4, repeats);
}

SceneFrame looking_down(const glm::dvec3& position) {
    SceneFrame frame;
    frame.width = frame.height = 48;
    frame.camera.position_m = position;
    frame.camera.azimuth_degrees = 0;
    frame.camera.elevation_degrees = -90;
    frame.camera.horizontal_field_degrees = 90;
    frame.ground = true;
    return frame;
}

glm::dvec3 seen_on_ground(const SceneFrame& frame, int x, int y) {
    const glm::dvec3 ray = CameraRays(frame.camera, frame.width, frame.height).through(x, y);
    return frame.camera.position_m - frame.camera.position_m.z / ray.z * ray;
}

// The metres that a ray to the sun spends in the tile, by the slabs between its faces.
double way_in_tile(const glm::dvec3& from, const glm::dvec3& sun) {
    const double low[] = {0, 0, 1000};
    const double high[] = {1600, 1600, 1400};
    double enters = 0;
    double leaves = 1e9;
    for (int a = 0; a < 3; ++a) {
        const double first = (low[a] - from[a]) / sun[a];
        const double last = (high[a] - from[a]) / sun[a];
        enters = std::max(enters, std::min(first, last));
        leaves = std::min(leaves, std::max(first, last));
    }
    return std::max(leaves - enters, 0.0);
}

// Sunlight enters a tile through its sides as well as through its base, however far clouds are shown.
TEST(GroundShadow, OfOneTileIsThatOfItsBox) {
    const CloudMedium tile = slab(false);
    for (const double elevation : {70.0, 30.0, 12.0}) {
        const double reach_m = elevation == 30 ? 900 : 20000;
        const SunDirection sun = {elevation, 205};
        const glm::dvec3 to_sun = direction_of(elevation, 205);
        const SceneMarch march({{&tile, 20, 5, reach_m, false}}, sun, true, true, 1);
        // The camera looks at the ground from where the shadow falls, below the cloud's base.
        const glm::dvec3 middle = glm::dvec3(800, 800, 1200) - 1200 / to_sun.z * to_sun;
        const SceneFrame frame = looking_down({middle.x + 130, middle.y - 210, 990});
        const Image2<float> seen = march.march(frame, 1, nullptr).results;
        int dark = 0;
        int lit = 0;
        testing::for_each_texel(frame.width, frame.height, [&](int x, int y) {
            const double way = way_in_tile(seen_on_ground(frame, x, y), to_sun);
            const double direct = seen.texel(x, y)[7];
            // Density falls to 0 over the outermost half voxel, 25 m.
            const double edge = 25 / std::min(std::fabs(to_sun.x), std::fabs(to_sun.y));
            const double error = 1 - std::exp(-kExtinction * std::min(edge, way));
            EXPECT_NEAR(direct, std::exp(-kExtinction * way), error + 0.03) << elevation;
            dark += direct < 0.1 ? 1 : 0;
            lit += direct > 0.99 ? 1 : 0;
        });
        EXPECT_GT(dark, 20) << elevation;
        EXPECT_GT(dark + lit, 60) << elevation;
    }
}

// A tile alone darkens the ground in its shadow, and leaves all other ground as it is.
TEST(GroundShadow, OfOneTileLeavesOtherGroundAlone) {
    const CloudMedium medium = slab(false);
    const std::vector<SceneLayer> tile = {{&medium, 20, 20, 8000}};
    const SunDirection sun = {60, 205};
    SceneFrame frame = looking_down({6000, 6000, 500});
    const Image2<float> beside = picture_of(tile, sun, frame);
    frame.ground = false;
    const Image2<float> clear = picture_of(tile, sun, frame);
    for (std::size_t i = 0; i < clear.texels.size(); ++i) {
        EXPECT_NEAR(beside.texels[i], clear.texels[i], 1e-5 * clear.texels[i]);
    }
    const glm::dvec3 to_sun = direction_of(60, 205);
    const glm::dvec3 shade = glm::dvec3(800, 800, 1200) - 1200 / to_sun.z * to_sun;
    frame = looking_down({shade.x, shade.y, 100});
    const float shaded = picture_of(tile, sun, frame).texel(24, 24)[1];
    frame.ground = false;
    EXPECT_LT(shaded, 0.5F * picture_of(tile, sun, frame).texel(24, 24)[1]);
}

// Half of a layer is cloud, so that hardly any ground has its mean shadow. Beyond the reach, all has. Where
// a ray meets no ground, nothing is shaded.
TEST(GroundShadow, BeyondTheReachIsTheMean) {
    std::vector<float> voxels(32 * 32 * 8);
    for (std::size_t i = 0; i < voxels.size(); ++i) voxels[i] = i % 32 < 16 ? 1.0F : 0.0F;
    const CloudMedium layer =
        test::medium_of({1600, 1600, 400}, 1000, {32, 32, 8}, voxels, kExtinction, 4);
    const SunDirection sun = {90, 0};
    SceneFrame frame = looking_down({0, 0, 900});
    frame.camera.elevation_degrees = -7;
    const SceneMarch march({{&layer, 20, 20, 3000}}, sun, true, true, 1);
    // Beside 15 voxels of each, density falls linearly over one. The mean is taken at 32 points, of which
    // each edge may miss half a one.
    const double depth = 0.01 * 400;
    EXPECT_NEAR(march.direct(),
                (15 + 15 * std::exp(-depth) + 2 * (1 - std::exp(-depth)) / depth) / 32, 1.0 / 32);
    const Image2<float> seen = march.march(frame, 1, nullptr).results;
    const CameraRays rays(frame.camera, frame.width, frame.height);
    std::array<int, 3> pixels{};  // of the sky, of near ground and of far ground
    testing::for_each_texel(frame.width, frame.height, [&](int x, int y) {
        const double z = rays.through(x, y).z;
        const double direct = seen.texel(x, y)[7];
        if (z > 0) {
            EXPECT_EQ(direct, 1);
            ++pixels[0];
        } else if (900 / -z > 3000) {
            EXPECT_NEAR(direct, march.direct(), 1e-6);
            ++pixels[2];
        } else {
            pixels[1] += direct < 0.05 || direct > 0.95 ? 1 : -1;
        }
    });
    for (const int count : pixels) EXPECT_GT(count, 50);
}

}  // namespace
}  // namespace skybake
