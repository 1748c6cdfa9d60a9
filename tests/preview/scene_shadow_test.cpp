// Tests the light of the sky and on the ground that clouds leave, and how far clouds are seen.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

#include "bakers/render/scene_view.h"
#include "bakers/render/sky_view.h"
#include "tests/preview/scenes.h"
#include "tests/support/loops.h"

namespace skybake {
namespace {

using namespace test;

// A layer without extinction is not seen, and casts no shadow. The ground's albedo varies from place to
// place.
TEST(SceneView, TransparentLayersGiveTheClearSky) {
    const CloudMedium low =
        medium_of({1000, 1000, 500}, 800, {4, 4, 4}, std::vector<float>(64, 1.0F), 0);
    const CloudMedium high =
        medium_of({1500, 900, 500}, 4000, {4, 4, 4}, std::vector<float>(64, 0.0F));
    SkyMedium over_black_ground = earth().medium;
    over_black_ground.air.ground_albedo = Spectrum(0.0);
    for (const double elevation : {60.0, 5.0, 0.0, -4.0}) {
        SceneFrame frame = frame_from({0, 0, 300}, 0, 96, 72);
        frame.ground = true;
        const Image2<float> made =
            picture_of({{&low, 40, 40, 9000}, {&high, 40, 40, 9000}}, {elevation, 80}, frame);
        const CameraRays rays(frame.camera, frame.width, frame.height);
        for (int y = 6; y < frame.height; y += 12) {
            for (int x = 6; x < frame.width; x += 12) {
                // The sky along this ray alone: a panorama of one pixel.
                const glm::dvec3 ray = rays.through(x, y);
                SkyView view;
                view.projection = SkyProjection::panorama;
                view.width = view.height = 1;
                view.camera_altitude_km = 0.3;
                view.sun_elevation_degrees = elevation;
                const double up = std::asin(ray.z) * 180 / M_PI;
                if (std::fabs(up) < 2) continue;  // the table's rows cannot show the horizon's edge
                view.lowest_degrees = up - 1e-3;
                view.highest_degrees = up + 1e-3;
                const double turn = std::atan2(ray.y, ray.x) * 180 / M_PI - 80;
                view.width = 720;
                const Image2<float> sky = render_sky(earth().medium, earth().tables, view, 1);
                const Image2<float> air = render_sky(over_black_ground, earth().tables, view, 1);
                const Spectrum ground =
                    mottled(earth().medium.air.ground_albedo,
                            ground_mottle_along(frame.camera.position_m, ray, rays.pixel()));
                const int column =
                    static_cast<int>(std::floor(std::fmod(turn + 180 + 720, 360) * 2));
                for (int c = 0; c < 3; ++c) {
                    const double above = air.texel(column, 0)[c];
                    const double wanted = above + ground[static_cast<std::size_t>(c)] *
                                                      (sky.texel(column, 0)[c] - above);
                    EXPECT_NEAR(made.texel(x, y)[c], wanted, 0.03 * wanted + 1e-5)
                        << elevation << " " << up;
                }
            }
        }
    }
}

// Under an overcast no direct sun is left: f = D (E_sun + E_sky) / (E_sun + E_sky) = D, which two-stream
// theory gives as 2 / (2 + (1 - g) tau).
TEST(SceneView, GroundUnderAnOvercastHasTheLightThatPasses) {
    const double height = 500;
    for (const double tau : {8.0, 40.0}) {
        const CloudMedium slab = medium_of({1000, 1000, height}, 1000, {4, 4, 64},
                                           std::vector<float>(4 * 4 * 64, 1.0F), tau / height);
        const std::vector<SceneLayer> layers = {{&slab, 10, 10, 9000}};
        SceneFrame frame = frame_from({0, 0, 2}, -40, 8, 6);
        frame.ground = true;
        const SunDirection sun = {30, 80};
        const Image2<float> shaded = picture_of(layers, sun, frame);
        frame.ground = false;
        const Image2<float> bright = picture_of(layers, sun, frame);
        const double g = mean_cosine(droplet_phase(kDropletDiameter_um));
        const double passes = 2 / (2 + (1 - g) * tau);
        for (std::size_t i = 0; i < shaded.texels.size(); ++i) {
            EXPECT_NEAR(double{shaded.texels[i]} / bright.texels[i], passes, 0.01) << tau;
        }
    }
}

// Half of the ground lies in the shadow of an opaque block, and the sun stands at the zenith.
TEST(SceneView, ShadowsLieUnderTheirClouds) {
    const std::array<int, 3> size = {16, 4, 4};
    std::vector<float> voxels(16 * 4 * 4, 0.0F);
    for (std::size_t i = 0; i < voxels.size(); ++i) voxels[i] = i % 16 < 8 ? 1.0F : 0.0F;
    const CloudMedium block = medium_of({1600, 1600, 400}, 1000, size, voxels, 0.1);
    const SceneMarch march({{&block, 10, 10, 9000}}, {90, 0}, true, true, 1);
    // Beside seven clear voxels, the density falls linearly from 1 to 0 over one on each side, where the
    // mean of exp(-40 v) is 1 / 40. The mean is taken at 32 points.
    EXPECT_NEAR(march.direct(0), (7 + 2.0 / 40) / 16, 0.5 / 32);
    SceneFrame frame = frame_from({800, 800, 500}, -90, 32, 32);
    frame.camera.azimuth_degrees = 0;
    frame.camera.horizontal_field_degrees = 60;
    frame.ground = true;
    const Image2<float> results = march.march(frame, 1, nullptr).results;
    const CameraRays rays(frame.camera, 32, 32);
    testing::for_each_texel(32, 32, [&](int x, int y) {
        const glm::dvec3 ray = rays.through(x, y);
        const double at = 800 - ray.x / ray.z * 500;
        if (std::fabs(at - 800) < 60) return;
        EXPECT_NEAR(results.texel(x, y)[7], at < 800 ? 0 : 1, 1e-3) << at;
    });
}

TEST(SceneView, FadesWithinTheReach) {
    const CloudMedium slab =
        medium_of({1000, 1000, 500}, 1000, {4, 4, 4}, std::vector<float>(64, 1.0F), 0.02);
    SceneFrame frame = frame_from({0, 0, 2}, 8, 4, 64);
    const Image2<float> results =
        SceneMarch({{&slab, 20, 20, 10000, true}}, {40, 80}, true, true, 1)
            .march(frame, 1, nullptr)
            .results;
    const CameraRays rays(frame.camera, 4, 64);
    double before = -1;
    for (int y = 63; y >= 0; --y) {  // upwards
        const double z = rays.through(2, y).z;
        if (z <= 0) continue;
        const double through = results.texel(2, y)[6];
        if (1000 / z > 10000) {
            EXPECT_EQ(through, 1) << z;
        }
        if (1500 / z < 6700) {
            EXPECT_LT(through, 1e-3) << z;
        }
        if (before >= 0) {
            EXPECT_LE(through, before + 1e-6) << z;
        }
        before = through;
    }
}

}  // namespace
}  // namespace skybake
