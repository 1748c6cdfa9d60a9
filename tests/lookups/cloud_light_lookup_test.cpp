// Light within a cloud: lookups of its texels, and the harmonics that they are coefficients of.
#include "bakers/assets/cloud_light/harmonics.h"
#include "bakers/field/image.h"
#include "tests/lookups/lookup_trial.h"

namespace skybake {
namespace gpu::light_lookups {
#include "lookups/cloud_light.glsl.h"
}  // namespace gpu::light_lookups

namespace {

using gpu::vec3;
using gpu::vec4;

const std::string kCloud =
    "[noise.shape]\npreset = 'nubis_shape'\npack = 'shape'\n[clouds.c]\nnoise = 'shape'\n"
    "noise_scale = [1, 1, 1]\nextent = ['3 km', '3.2 km', '1 km']\nbase_altitude = '1 km'\n"
    "height_profile = { type = 'cumulus' }\ncoverage = 0.06\n"
    "[bake.cloud]\nasset = 'cloud_volume'\ncloud = 'c'\nsize = [60, 64, 20]\n"
    "[bake.light]\nasset = 'cloud_light'\nof = 'cloud'\npixel_type = 'float'\ncell = 4\n";

TEST(CloudLightLookup, FloatLosesLittle) {
    const test::BakedLookup baked =
        test::bake_all(kCloud + "sun_elevations = ['60 deg', '30 deg', '10 deg']\n");
    const Baked& light = baked.asset(1);
    const Texture texture = texture_of(light);
    const vec3 tile(3000, 3200, 1000);
    test::Dice dice;
    test::Loss loss;
    for (int i = 0; i < test::kPlaces; ++i) {
        const vec3 p(dice.uniform(-9000, 9000), dice.uniform(-9000, 9000), dice.uniform(0, 1000));
        const vec4 found = gpu::light_lookups::cloud_light({texture}, p, tile);
        std::array<double, 3> place{};
        for (std::size_t a = 0; a < 3; ++a) {
            const auto axis = static_cast<vec3::length_type>(a);
            place[a] = double{p[axis]} / double{tile[axis]};
        }
        const std::array<double, 4> wanted = filtered(texture, place);
        for (std::size_t c = 0; c < 3; ++c) {
            const ValueStatistics& s = light.levels.front().statistics[c];
            loss.add((double{found[static_cast<vec4::length_type>(c)]} - wanted[c]) /
                     (s.max - s.min));
        }
    }
    test::expect_little_loss(loss, light.certificate);
    for (const Probe& probe : light.levels.front().probes) {
        const vec3 p(test::at(probe, "x_m"), test::at(probe, "y_m"),
                     test::at(probe, "altitude_m") - 1000);
        test::expect_probe(gpu::light_lookups::cloud_light({texture}, p, tile), probe.value,
                           probe.tolerance, "x_m " + std::to_string(p.x));
    }
}

TEST(CloudLightLookup, AShadowIsAMapOfOneSlice) {
    const test::BakedLookup baked =
        test::bake_all(kCloud + "contents = 'shadow'\nsun_elevations = ['30 deg']\n");
    const Baked& light = baked.asset(1);
    const Texture texture = texture_of(light);
    const vec3 tile(3000, 3200, 1000);
    for (const Probe& probe : light.levels.front().probes) {
        EXPECT_EQ(test::at(probe, "altitude_m"), 1000);
        const vec3 p(test::at(probe, "x_m"), test::at(probe, "y_m"), 0);
        test::expect_probe(gpu::light_lookups::cloud_shadow({texture}, p, tile), probe.value,
                           probe.tolerance, "x_m " + std::to_string(p.x));
    }
}

TEST(CloudLightLookup, HarmonicsAreThoseOfTheBaker) {
    test::Dice dice;
    for (int i = 0; i < 1000; ++i) {
        const glm::dvec3 direction = dice.direction();
        const cloud_light::Harmonics wanted = cloud_light::harmonics(direction);
        const vec3 d(direction);
        const std::array<vec4, 4> found = {
            gpu::light_lookups::cloud_harmonics_1(d), gpu::light_lookups::cloud_harmonics_2(d),
            gpu::light_lookups::cloud_harmonics_3(d), gpu::light_lookups::cloud_harmonics_4(d)};
        for (std::size_t k = 0; k < wanted.size(); ++k) {
            const auto component = static_cast<vec4::length_type>(k % 4);
            EXPECT_NEAR(found[k / 4][component], wanted[k], 2e-6) << k;
        }
    }
}

}  // namespace
}  // namespace skybake
