// The light of clouds around a camera, put together from its parts: each is computed here along the ray
// itself, from the light that the air has.
#include <gtest/gtest.h>

#include "bakers/assets/environment/environment_clouds.h"
#include "tests/environment/maps.h"
#include "tests/light/sky_media.h"
#include "tests/preview/lit_slabs.h"

namespace skybake {
namespace {

using config::EnvironmentBake;
using config::SkyOrders;
using test::kDegree;
using test::TestSky;

const SkyLight& hazy() {
    static const TestSky sky(test::preset_atmosphere("earth_hillaire", test::kHaze),
                             SkyOrders::all);
    return sky.light();
}

// Maps have y upwards, and z ahead.
glm::dvec3 with_z_up(const glm::dvec3& direction) {
    return {direction.x, direction.z, direction.y};
}

// A slab, or two of them, the upper one thin.
struct LitScene {
    double altitude_m;
    std::array<int, 2> texel;
    std::vector<test::Slab> slabs;  // from the highest
    double sun_elevation = 25;
};

void expect_parts(const LitScene& scene) {
    std::vector<CloudMedium> media;
    for (const test::Slab& slab : scene.slabs) media.push_back(slab.medium());
    EnvironmentBake bake;
    bake.size = {32, 16};
    bake.altitude = {scene.altitude_m};
    bake.sun_elevation = {scene.sun_elevation * kDegree};
    bake.sun_azimuth = {70 * kDegree};
    const Image2<float> map = test::baked(bake, media, Certification::off, 1, hazy()).image();
    const EnvironmentLayout layout(bake.mapping, bake.size);
    const CloudsAround clouds(media, bake, layout, true, {.threads = 1});
    const auto [column, row] = scene.texel;
    const SeenClouds seen = clouds.texel(0, column, row);
    const test::LightOfAir light{
        hazy().shell(), hazy().integrator(),
        with_z_up(direction_of_angles({70 * kDegree, scene.sun_elevation * kDegree})),
        [](double altitude_km, double s_km) {
            return hazy().sun_transmittance(altitude_km, s_km);
        }};
    const SkyRay ray =
        light.ray(scene.altitude_m / 1000,
                  with_z_up(layout.direction(0, (column + 0.5) / 32, (row + 0.5) / 16)));
    const Spectrum wanted = seen.transmittance * light.integrator.radiance(ray).total() +
                            light.of_slabs(scene.slabs, seen.layers, ray);
    for (std::size_t c = 0; c < 3; ++c) {
        EXPECT_NEAR(map.texel(column, row)[c] / wanted[c], 1, 0.02)
            << scene.altitude_m << " " << column << " " << row << " channel " << c;
    }
}

TEST(EnvironmentLight, IsTheSumOfItsPartsFromBelow) {
    for (const std::array<int, 2> texel : {std::array{28, 6}, {20, 3}, {4, 5}}) {
        expect_parts({0, texel, {{1500, 12}}});
        expect_parts({0, texel, {{1500, 0.4}}});
    }
    // Haze dims a low sun much more at the base than at the top.
    expect_parts({0, {20, 3}, {{1500, 0.4}}, 4});
    expect_parts({0, {20, 3}, {{1500, 3}}, 4});
}

TEST(EnvironmentLight, IsTheSumOfItsPartsFromAbove) {
    for (const std::array<int, 2> texel : {std::array{28, 9}, {5, 10}}) {
        expect_parts({4000, texel, {{1000, 20}}});
        expect_parts({4000, texel, {{1000, 0.6}}});
    }
}

TEST(EnvironmentLight, IsTheSumOfItsPartsOfTwoLayers) {
    expect_parts({0, {28, 5}, {{3000, 1.5}, {1000, 0.7}}});
    expect_parts({0, {5, 4}, {{3000, 1.5}, {1000, 0.7}}});
    expect_parts({2500, {9, 11}, {{3000, 6}, {1000, 3}}});
    expect_parts({2500, {24, 10}, {{3000, 6}, {1000, 3}}});
}

// The sun is below the horizontal, but above the horizon of the base, 1.76 degrees deep. With two layers it
// shines on the high one alone.
TEST(EnvironmentLight, IsTheSumOfItsPartsAtSunset) {
    expect_parts({5000, {16, 10}, {{3000, 20}}, -1.6});
    expect_parts({2000, {16, 4}, {{4000, 3}, {500, 0.3}}, -1.4});
}

}  // namespace
}  // namespace skybake
