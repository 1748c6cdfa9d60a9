#include "bakers/render/scene_view.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <vector>

#include "bakers/render/cloud_framing.h"
#include "bakers/render/sky_view.h"
#include "tests/noise/every_target.h"
#include "tests/preview/clouds.h"
#include "tests/preview/skies.h"
#include "tests/support/scene_reference.h"

namespace skybake {
namespace {

using test::cloud_of;
using test::clumped_voxels;

CloudMedium medium_of(const std::array<double, 3>& extent_m, double base_m,
                      const std::array<int, 3>& size, const std::vector<float>& voxels,
                      double extinction_per_m = 0.01) {
    config::Cloud cloud = cloud_of(extent_m, base_m);
    cloud.extinction_scale.per_meter = extinction_per_m;
    CloudMedium medium = cloud_medium(cloud, voxels.data(), size, 1, 1);
    medium.leaps = leaps_of_voxels(medium, 2, 1);
    return medium;
}

CloudMedium clumps(const std::array<double, 3>& extent_m, double base_m,
                   const std::array<int, 3>& size, std::uint32_t seed, double filled = 0.3) {
    return medium_of(extent_m, base_m, size, clumped_voxels(size, seed, filled));
}

// Three layers: two that overlap in altitude and one far above, of tiles of different sizes.
struct ThreeLayers {
    CloudMedium low = clumps({1200, 900, 600}, 500, {12, 9, 6}, 3);
    CloudMedium overlapping = clumps({700, 1100, 500}, 800, {7, 11, 5}, 4);
    CloudMedium high = clumps({2000, 1500, 300}, 2500, {10, 15, 4}, 5);

    explicit ThreeLayers(bool varied = false) {
        for (CloudMedium* medium : {&low, &overlapping, &high}) {
            if (varied) medium->variation = varied_tiles(*medium);
        }
    }
    std::vector<SceneLayer> layers(double step_m) const {
        return {{&low, step_m, step_m, 8000, false},
                {&overlapping, step_m, step_m, 8000, false},
                {&high, step_m, step_m, 8000, false}};
    }
};

SceneFrame frame_from(const glm::dvec3& position, double elevation_degrees, int width = 6,
                      int height = 4) {
    SceneFrame frame;
    frame.width = width;
    frame.height = height;
    frame.camera.position_m = position;
    frame.camera.azimuth_degrees = 33;
    frame.camera.elevation_degrees = elevation_degrees;
    return frame;
}

bool same_bits(const Image2<float>& a, const Image2<float>& b) {
    return a.texels.size() == b.texels.size() &&
           std::memcmp(a.texels.data(), b.texels.data(), a.texels.size() * sizeof(float)) == 0;
}

void expect_definition(const ThreeLayers& three, const SunDirection& sun, const SceneFrame& frame) {
    const std::vector<SceneLayer> layers = three.layers(4);
    const Image2<float> made =
        SceneMarch(layers, sun, true, true, 1).march(frame, 1, nullptr).results;
    const CameraRays rays(frame.camera, frame.width, frame.height);
    int cloudy = 0;
    for (int y = 0; y < frame.height; ++y) {
        for (int x = 0; x < frame.width; ++x) {
            const float* seen = made.texel(x, y);
            const ReferenceScene wanted =
                reference_scene(layers, sun, frame.camera, rays.through(x, y), 700);
            EXPECT_NEAR(seen[18], wanted.transmittance, 0.006 + 0.03 * wanted.transmittance);
            for (const ReferenceLayer& layer : wanted.layers) {
                const double values[] = {layer.sun_at_base, layer.sun_at_top, layer.from_sky,
                                         layer.from_ground, layer.opacity};
                for (const double value : values) {
                    EXPECT_NEAR(*seen++, value, 0.006 + 0.03 * value) << sun.elevation_degrees;
                }
                EXPECT_NEAR(*seen++, layer.distance_m, 8 + 0.03 * layer.distance_m);
            }
            cloudy += wanted.transmittance < 0.9 ? 1 : 0;
        }
    }
    EXPECT_GT(cloudy, 6);
}

TEST(SceneView, IsTheDefinition) {
    const ThreeLayers three;
    for (const SunDirection& sun : {SunDirection{35, 200}, {12, 80}, {90, 0}, {-15, 40}}) {
        expect_definition(three, sun, frame_from({100, 50, 100}, 45));
    }
    expect_definition(three, {50, 10}, frame_from({0, 0, 3200}, -50));
    expect_definition(three, {50, 10}, frame_from({0, 0, 900}, 10));
}

TEST(SceneView, CopiesOfTilesAreTheirDefinition) {
    const ThreeLayers three(true);
    SceneFrame frame = frame_from({100, 50, 100}, 45, 12, 8);
    for (const double elevation : {35.0, -15.0}) {
        const SunDirection sun = {elevation, 200};
        const std::vector<SceneLayer> layers = three.layers(4);
        const Image2<float> made =
            SceneMarch(layers, sun, true, true, 1).march(frame, 1, nullptr).results;
        const CameraRays rays(frame.camera, frame.width, frame.height);
        for (int y = 0; y < frame.height; y += 2) {
            for (int x = 0; x < frame.width; x += 3) {
                const ReferenceScene wanted =
                    reference_scene(layers, sun, frame.camera, rays.through(x, y), 400);
                const float* seen = made.texel(x, y);
                EXPECT_NEAR(seen[18], wanted.transmittance, 0.012 + 0.03 * wanted.transmittance);
                for (int l = 0; l < 3; ++l) {
                    const ReferenceLayer& layer = wanted.layers[static_cast<std::size_t>(l)];
                    const double sunlight = layer.sun_at_base + layer.sun_at_top;
                    EXPECT_NEAR(seen[6 * l] + seen[6 * l + 1], sunlight, 0.01 + 0.05 * sunlight);
                    EXPECT_NEAR(seen[6 * l + 4], layer.opacity, 0.012 + 0.03 * layer.opacity);
                }
            }
        }
    }
}

// A periodic layer is the same from one tile further on; a varied one is not.
TEST(SceneView, CopiesOfTilesDiffer) {
    for (const bool varied : {false, true}) {
        const ThreeLayers three(varied);
        const std::vector<SceneLayer> layers = {{&three.low, 20, 20, 8000, false}};
        const SceneMarch march(layers, {35, 200}, true, true, 1);
        const auto from = [&](double x_m) {
            return march.march(frame_from({x_m, 50, 100}, 45, 24, 16), 1, nullptr).results;
        };
        const Image2<float> here = from(100);
        const Image2<float> next = from(100 + three.low.extent_m[0]);
        double most = 0;
        for (std::size_t i = 0; i < here.texels.size(); i += 8) {
            most = std::max(most, std::fabs(double{here.texels[i + 6]} - next.texels[i + 6]));
        }
        EXPECT_EQ(most > 0.3, varied) << most;
    }
}

// What a recipe places is there: between its margins, the first copy is the volume.
TEST(SceneView, TheFirstCopyIsTheVolume) {
    const ThreeLayers plain;
    const ThreeLayers varied(true);
    const auto [x_m, y_m, z_m] = plain.low.extent_m;
    int cloudy = 0;
    for (int i = 0; i < 64; ++i) {
        const glm::dvec3 share = {(i % 4 + 0.5) / 4, (i / 4 % 4 + 0.5) / 4, (i / 16 + 0.5) / 4};
        const glm::dvec3 at = {x_m * (0.14 + 0.72 * share.x), y_m * (0.14 + 0.72 * share.y),
                               plain.low.base_m + z_m * share.z};
        const double wanted = reference_extinction(plain.low, at);
        EXPECT_DOUBLE_EQ(reference_extinction(varied.low, at), wanted);
        cloudy += wanted > 0 ? 1 : 0;
    }
    EXPECT_GT(cloudy, 8);
}

TEST(SceneView, LeapingThreadsAndTargetsChangeNoBit) {
    for (const bool varied : {false, true}) {
        const ThreeLayers three(varied);
        for (const double elevation : {40.0, 3.0, 0.0, -10.0}) {
            const SunDirection sun = {elevation, 80};
            SceneFrame frame = frame_from({100, 50, 100}, 20, 40, 24);
            frame.refinement = Refinement::thin;
            frame.ground = true;
            const auto march = [&](bool leaping, int threads) {
                return SceneMarch(three.layers(15), sun, true, leaping, threads)
                    .march(frame, threads, nullptr);
            };
            const MarchedScene one = march(true, 1);
            const MarchedScene straight = march(false, 1);
            EXPECT_TRUE(same_bits(one.results, straight.results)) << varied << elevation;
            EXPECT_LT(one.fetches.samples, straight.fetches.samples);
            EXPECT_GT(one.refined_pixels, 0);
            EXPECT_TRUE(same_bits(one.results, march(true, 3).results));
            for (const float value : one.results.texels) ASSERT_TRUE(std::isfinite(value));
            if (elevation != 40) continue;
            test::on_every_target([&](const char* target) {
                EXPECT_TRUE(same_bits(march(true, 1).results, one.results)) << target;
            });
        }
    }
}

const test::Sky& earth() {
    static const test::Sky sky = test::sky_of("earth_hillaire");
    return sky;
}

Image2<float> picture_of(const std::vector<SceneLayer>& layers, const SunDirection& sun,
                         const SceneFrame& frame) {
    SceneRenderer renderer(layers, {earth().medium, earth().tables}, sun, 1);
    return renderer.render(frame, 1).radiance;
}

double greatest_difference(const Image2<float>& a, const Image2<float>& b) {
    double most = 0;
    for (std::size_t i = 0; i < a.texels.size(); ++i) {
        most = std::max(most, std::fabs(double{a.texels[i]} - b.texels[i]));
    }
    return most;
}

TEST(SceneView, OrderOfLayersDoesNotMatter) {
    const ThreeLayers three(true);
    std::vector<SceneLayer> layers = three.layers(20);
    SceneFrame frame = frame_from({100, 50, 100}, 12, 24, 16);
    frame.ground = true;
    const Image2<float> first = picture_of(layers, {20, 80}, frame);
    std::rotate(layers.begin(), layers.begin() + 1, layers.end());
    EXPECT_TRUE(same_bits(picture_of(layers, {20, 80}, frame), first));
    std::swap(layers[0], layers[1]);
    EXPECT_TRUE(same_bits(picture_of(layers, {20, 80}, frame), first));
    layers.pop_back();
    EXPECT_GT(greatest_difference(picture_of(layers, {20, 80}, frame), first), 1e-3);
}

// What has no extinction is not seen, and casts no shadow.
TEST(SceneView, TransparentLayersGiveTheClearSky) {
    const CloudMedium low =
        medium_of({1000, 1000, 500}, 800, {4, 4, 4}, std::vector<float>(64, 1.0F), 0);
    const CloudMedium high =
        medium_of({1500, 900, 500}, 4000, {4, 4, 4}, std::vector<float>(64, 0.0F));
    for (const double elevation : {60.0, 5.0, 0.0, -4.0}) {
        SceneFrame frame = frame_from({0, 0, 300}, 0, 96, 72);
        frame.ground = true;
        const Image2<float> made = picture_of(
            {{&low, 40, 40, 9000, false}, {&high, 40, 40, 9000, false}}, {elevation, 80}, frame);
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
                const int column =
                    static_cast<int>(std::floor(std::fmod(turn + 180 + 720, 360) * 2));
                for (int c = 0; c < 3; ++c) {
                    const double wanted = sky.texel(column, 0)[c];
                    EXPECT_NEAR(made.texel(x, y)[c], wanted, 0.03 * wanted + 1e-5)
                        << elevation << " " << up;
                }
            }
        }
    }
}

// A layer that nobody can see changes nothing.
TEST(SceneView, AnEmptyLayerChangesNothing) {
    const ThreeLayers three;
    const CloudMedium empty =
        medium_of({900, 900, 400}, 700, {3, 3, 3}, std::vector<float>(27, 0.0F));
    SceneFrame frame = frame_from({100, 50, 100}, 5, 24, 16);
    frame.ground = true;
    const Image2<float> alone = picture_of({{&three.low, 20, 20, 8000, false}}, {20, 80}, frame);
    const Image2<float> both = picture_of(
        {{&empty, 30, 30, 9000, false}, {&three.low, 20, 20, 8000, false}}, {20, 80}, frame);
    // The air's table spans the farther reach.
    EXPECT_LT(greatest_difference(alone, both), 2e-4);
}

// Under an overcast no direct sun is left: f = D (E_sun + E_sky) / (E_sun + E_sky) = D, which two-stream
// theory gives as 2 / (2 + (1 - g) tau).
TEST(SceneView, GroundUnderAnOvercastHasTheLightThatPasses) {
    const double height = 500;
    for (const double tau : {8.0, 40.0}) {
        const CloudMedium slab = medium_of({1000, 1000, height}, 1000, {4, 4, 64},
                                           std::vector<float>(4 * 4 * 64, 1.0F), tau / height);
        const std::vector<SceneLayer> layers = {{&slab, 10, 10, 9000, false}};
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
    const SceneMarch march({{&block, 10, 10, 9000, false}}, {90, 0}, true, true, 1);
    // Beside seven clear voxels, the density falls linearly from 1 to 0 over one on each side, where the
    // mean of exp(-40 v) is 1 / 40. The mean is taken at 32 points.
    EXPECT_NEAR(march.direct(0), (7 + 2.0 / 40) / 16, 0.5 / 32);
    SceneFrame frame = frame_from({800, 800, 500}, -90, 32, 32);
    frame.camera.azimuth_degrees = 0;
    frame.camera.horizontal_field_degrees = 60;
    frame.ground = true;
    const Image2<float> results = march.march(frame, 1, nullptr).results;
    const CameraRays rays(frame.camera, 32, 32);
    for (int y = 0; y < 32; ++y) {
        for (int x = 0; x < 32; ++x) {
            const glm::dvec3 ray = rays.through(x, y);
            const double at = 800 - ray.x / ray.z * 500;
            if (std::fabs(at - 800) < 60) continue;
            EXPECT_NEAR(results.texel(x, y)[7], at < 800 ? 0 : 1, 1e-3) << at;
        }
    }
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

// Pictures of one renderer are those of a renderer for each: what it keeps depends on no camera.
TEST(SceneView, KeepsOnlyWhatCamerasShare) {
    const ThreeLayers three;
    SceneRenderer renderer(three.layers(20), {earth().medium, earth().tables}, {20, 80}, 1);
    for (const double elevation : {10.0, 40.0, 10.0}) {
        for (const double altitude : {100.0, 1500.0}) {
            const SceneFrame frame = frame_from({100, 50, altitude}, elevation, 16, 12);
            EXPECT_TRUE(same_bits(renderer.render(frame, 1).radiance,
                                  picture_of(three.layers(20), {20, 80}, frame)));
        }
    }
}

}  // namespace
}  // namespace skybake
