#include "bakers/render/scene_view.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "tests/noise/every_target.h"
#include "tests/preview/scenes.h"
#include "tests/support/loops.h"
#include "tests/support/scene_reference.h"

namespace skybake {
namespace {

using namespace test;

void expect_definition(const ThreeLayers& three, const SunDirection& sun, const SceneFrame& frame) {
    const std::vector<SceneLayer> layers = three.layers(4);
    const Image2<float> made =
        SceneMarch(layers, sun, true, true, 1).march(frame, 1, nullptr).results;
    const CameraRays rays(frame.camera, frame.width, frame.height);
    int cloudy = 0;
    testing::for_each_texel(frame.width, frame.height, [&](int x, int y) {
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
    });
    EXPECT_GT(cloudy, 6);
}

TEST(SceneView, IsTheDefinition) {
    const ThreeLayers three;
    for (const SunDirection& sun :
         {SunDirection{35, 200}, {12, 80}, {90, 0}, {0, 140}, {-15, 40}}) {
        expect_definition(three, sun, frame_from({100, 50, 100}, 45));
    }
    expect_definition(three, {50, 10}, frame_from({0, 0, 3200}, -50));
    expect_definition(three, {50, 10}, frame_from({0, 0, 900}, 10));
}

TEST(SceneView, CopiesOfTilesAreTheirDefinition) {
    const ThreeLayers three(true);
    for (const double elevation : {35.0, -15.0}) {
        expect_definition(three, {elevation, 200}, frame_from({100, 50, 100}, 45));
    }
}

// A periodic layer is the same from one tile further on; a varied one is not.
TEST(SceneView, CopiesOfTilesDiffer) {
    for (const bool varied : {false, true}) {
        const ThreeLayers three(varied);
        const std::vector<SceneLayer> layers = {{&three.low, 20, 20, 8000}};
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

// The volume is where a recipe places it: between its margins, the first copy is the volume.
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

// A layer that nobody can see changes nothing.
TEST(SceneView, AnEmptyLayerChangesNothing) {
    const ThreeLayers three;
    const CloudMedium empty =
        medium_of({900, 900, 400}, 700, {3, 3, 3}, std::vector<float>(27, 0.0F));
    SceneFrame frame = frame_from({100, 50, 100}, 5, 24, 16);
    frame.ground = true;
    const Image2<float> alone = picture_of({{&three.low, 20, 20, 8000}}, {20, 80}, frame);
    const Image2<float> both =
        picture_of({{&empty, 30, 30, 9000}, {&three.low, 20, 20, 8000}}, {20, 80}, frame);
    // The air's table spans the farther reach.
    EXPECT_LT(greatest_difference(alone, both), 2e-4);
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

// The layer is flat, and the planet is not: no cloud stands above the horizon that it would have.
TEST(SceneView, NoCloudStandsAboveItsHorizon) {
    const CloudMedium full = medium_of({900, 900, 400}, 700, {3, 3, 3}, std::vector<float>(27, 1));
    const CloudMedium empty = medium_of({900, 900, 400}, 700, {3, 3, 3}, std::vector<float>(27, 0));
    SceneFrame frame = frame_from({100, 50, 60e3}, -7.5, 2, 64);
    frame.camera.horizontal_field_degrees = 0.5;  // 16 degrees high: from 0.5 to -15.5
    const auto picture = [&](const CloudMedium& medium) {
        return picture_of({{&medium, 300, 300, 2e6}}, {20, 80}, frame);
    };
    const Image2<float> clouds = picture(full), clear = picture(empty);
    int cloudy = 0;
    for (int y = 0; y < 64; ++y) {
        const double elevation = CameraRays(frame.camera, 2, 64).through(0, y).z;
        const bool differs = std::fabs(clouds.texel(0, y)[0] / clear.texel(0, y)[0] - 1) > 0.02F;
        // arccos((6360 + 1.1) / (6360 + 60)) = 7.77 degrees
        if (elevation > -0.1352) {
            EXPECT_FALSE(differs) << y;
        } else {
            cloudy += differs;
        }
    }
    EXPECT_GT(cloudy, 16);
}

// From below there is no limb: a layer without gaps hides the zenith as it hides all else.
TEST(SceneView, AFullLayerHidesTheZenith) {
    const CloudMedium full = medium_of({900, 900, 400}, 700, {3, 3, 3}, std::vector<float>(27, 1));
    SceneFrame frame = frame_from({100, 50, 100}, 90, 9, 9);
    frame.camera.horizontal_field_degrees = 16;
    const Image2<float> made = picture_of({{&full, 20, 20, 8000}}, {20, 80}, frame);
    for (int x = 0; x < 9; ++x) {
        EXPECT_NEAR(made.texel(x, 4)[0] / made.texel(4, 4)[0], 1, 0.15) << x;
    }
}

// Clouds below the ground are hidden by it, and clouds that reach below it end there.
TEST(SceneView, TheGroundHidesWhatIsBelow) {
    const std::vector<float> ones(27, 1);
    const CloudMedium buried = medium_of({900, 900, 400}, -700, {3, 3, 3}, ones);
    const RaySpan span = span_in_layer(buried, {0, 0, 300}, {0, 0, -1}, 8000);
    EXPECT_LT(span.last_m, span.first_m);
    const CloudMedium half = medium_of({900, 900, 400}, -100, {3, 3, 3}, ones);
    EXPECT_EQ(span_in_layer(half, {0, 0, 500}, {0, 0, -1}, 8000).last_m, 500);
}

}  // namespace
}  // namespace skybake
