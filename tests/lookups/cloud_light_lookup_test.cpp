// Light within a cloud: lookups of its texels, and the harmonics that they are coefficients of.
#include <cmath>

#include "bakers/assets/cloud_light/cloud_scattering.h"
#include "bakers/assets/cloud_light/hemisphere_harmonics.h"
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
    const test::Loss lost = test::loss_at_places([&](test::Dice& dice, test::Loss& loss) {
        const vec3 p(dice.uniform(-9000, 9000), dice.uniform(-9000, 9000), dice.uniform(0, 1000));
        const vec4 found = gpu::light_lookups::cloud_light({texture}, p, tile);
        const auto wanted = gpu::filtered_at(texture, glm::dvec3(p) / glm::dvec3(tile));
        test::add_shares(found, wanted, light, loss);
    });
    test::expect_little_loss(lost, light.certificate);
}

TEST(CloudLightLookup, HarmonicsAreThoseOfTheBaker) {
    test::Dice dice;
    for (int i = 0; i < 1000; ++i) {
        const glm::dvec3 direction = dice.direction();
        const Harmonics wanted = harmonics(direction);
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

TEST(CloudLightLookup, ParticlesScatterAsTheBakerSays) {
    for (const float diameter : {5.0F, 12.0F, 50.0F}) {
        const cloud_light::CloudScattering wanted =
            cloud_light::scattering_of(droplet_phase(double{diameter}), 1);
        for (const float offset : {0.0F, 1e-5F, 0.01F, 0.5F, 1.0F, 1.9F, 2.0F}) {
            const double value =
                cloud_light::phase_value(wanted, double{offset}, 2 - double{offset});
            EXPECT_NEAR(gpu::light_lookups::cloud_droplet_phase(diameter, offset), value,
                        1e-3 * value)
                << diameter << ", " << offset;
            const double ice = phase_value(ice_phase(), double{offset});
            EXPECT_NEAR(gpu::light_lookups::cloud_ice_phase(offset), ice, 1e-5 * ice) << offset;
        }
    }
}

TEST(CloudLightLookup, SunlightIsScatteredOnce) {
    EXPECT_NEAR(gpu::light_lookups::cloud_first_scattering(0.3F, 2, 0.4F),
                0.3 / 0.4 * std::exp(-0.8), 1e-6);
    EXPECT_FLOAT_EQ(gpu::light_lookups::cloud_first_scattering(0.3F, 0, 1), 0.3F);
}

}  // namespace
}  // namespace skybake
