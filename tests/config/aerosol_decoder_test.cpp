// Layers that name OPAC's mixtures or kinds of spheres.
#include <gtest/gtest.h>

#include <string>

#include "config/fields/fields.h"
#include "config/optics/aerosol_components.h"
#include "config/sections/spectral_air.h"
#include "tests/config/recipes.h"

namespace skybake::config {
namespace {

const std::string haze =
    "[atmosphere]\nground_radius = '6371 km'\ntop_radius = '6471 km'\nground_albedo = 0\n"
    "[atmosphere.layers.haze]\nprofile = 'exponential'\n"
    "scale_height = '2 km'\n";

Layer layer_of(const std::string& text) {
    const Recipe recipe = valid(haze + text);
    const Layer* found = find_layer(recipe.parameters, "haze");
    return found ? *found : Layer{};
}

TEST(AerosolDecoder, MixturesHaveOpacsSpheres) {
    const Layer layer = layer_of("aerosol = 'continental_polluted'\nrelative_humidity = '80 %'\n");
    EXPECT_EQ(layer.phase, Phase::mie);
    ASSERT_EQ(layer.particles.kinds.size(), 3u);
    EXPECT_EQ(layer.particles.kinds, kinds_of(AerosolMixture::continental_polluted, 0.8));
    const SphereKind& first = layer.particles.kinds[0];
    EXPECT_EQ(first.particles.name, "water_soluble");
    EXPECT_EQ(first.number_density.per_cubic_meter, 15700e6);
    EXPECT_NEAR(first.particles.radius.meters, 0.0306e-6, 1e-15);
    EXPECT_EQ(layer.particles.wavelengths.size(), 3u);
    EXPECT_TRUE(layer.scattering.empty());
    EXPECT_EQ(layer, layer_of("aerosol = 'continental_polluted'\n")) << "80 % is the default";
    EXPECT_NE(layer, layer_of("aerosol = 'continental_polluted'\nrelative_humidity = 0.5\n"));
}

// The words of recipes are those of the tables.
TEST(AerosolDecoder, KnowsAllMixtures) {
    const Field* field = find_field(*find_section("atmosphere.layers.*"), "aerosol");
    ASSERT_EQ(field->choices.size(), all_aerosol_mixtures().size());
    for (const AerosolMixture mixture : all_aerosol_mixtures())
        EXPECT_EQ(choice_name(*field, mixture), name_of(mixture));
}

TEST(AerosolDecoder, AmountsReplaceNumbers) {
    EXPECT_EQ(layer_of("aerosol = 'urban'\noptical_depth = 0.3\n").particles.optical_depth, 0.3);
    const Layer depth = layer_of("aerosol = 'urban'\noptical_depth = 0.3\n");
    EXPECT_NEAR(depth.particles.extinction->per_meter, 0.3 / 2000, 1e-15);
    const Layer seen = layer_of("aerosol = 'urban'\nvisibility = '10 km'\n");
    EXPECT_NEAR(seen.particles.extinction->per_kilometer() + 0.01162, 0.3912, 1e-9);
    const Layer numbered = layer_of("aerosol = 'urban'\nnumber_density = '79000.75 /cm3'\n");
    EXPECT_FALSE(numbered.particles.extinction);
    EXPECT_NEAR(numbered.particles.kinds[0].number_density.per_cubic_meter, 14000e6, 1);
}

TEST(AerosolDecoder, ComponentsAreOpacsOrTheRecipes) {
    const std::string dust =
        "components = [['soot', '8300 /cm3'], ['grit', '1 /cm3']]\n[particles.grit]\n"
        "material = 'tabulated'\nindices = [['400 nm', 1.5, 0.01], ['700 nm', 1.5, 0.003]]\n"
        "effective_radius = '1.6 um'\n";
    const Layer layer = layer_of(dust);
    ASSERT_EQ(layer.particles.kinds.size(), 2u);
    EXPECT_EQ(layer.particles.kinds[0].particles.name, "soot");
    EXPECT_EQ(layer.particles.kinds[1].particles.indices.size(), 2u);
    EXPECT_EQ(layer.particles.kinds[1].number_density.per_cubic_meter, 1e6);
    // A recipe's own soot goes first.
    const Layer own = layer_of(
        "components = [['soot', '1 /cm3']]\n[particles.soot]\n"
        "effective_radius = '2 um'\n");
    EXPECT_EQ(own.particles.kinds.at(0).particles.material, ParticleMaterial::water);
}

TEST(AerosolDecoder, TheirParametersAreARecipe) {
    for (const char* text :
         {"aerosol = 'desert'\noptical_depth = 0.3\n",
          "components = [['soot', '8300 /cm3'], ['sea_salt_coarse', '0.1 /cm3']]\n",
          "components = [['p', '3 /cm3']]\nrelative_humidity = 0.9\n[particles.p]\n"
          "material = 'tabulated'\nindices = [['400 nm', 1.5, 0.01], ['700 nm', 1.5, 0]]\n"
          "effective_radius = '1 um'\nsmallest_radius = '0.1 um'\nlargest_radius = '9 um'\n"}) {
        const std::string all = testing::all_parameters(valid(haze + text));
        EXPECT_EQ(testing::all_parameters(valid(all)), all);
    }
}

TEST(AerosolDecoder, ParticlesMayHaveAnOpticalDepth) {
    const std::string drops = "[particles.drops]\neffective_radius = '10 um'\n";
    const Layer layer = layer_of("phase = { mie = 'drops' }\noptical_depth = 0.4\n" + drops);
    EXPECT_NEAR(layer.particles.extinction->per_meter, 0.4 / 2000, 1e-15);
}

// A preset's haze made of a mixture instead: nothing of the preset's is left to contradict it, its
// amount neither.
TEST(AerosolDecoder, ReplaceWhatAPresetsLayerIs) {
    const Recipe urban =
        valid("preset = 'earth'\n[atmosphere.layers.aerosol]\naerosol = 'urban'\n");
    const Layer* layer = find_layer(urban.parameters, "aerosol");
    ASSERT_TRUE(layer);
    EXPECT_EQ(layer->phase, Phase::mie);
    EXPECT_FALSE(layer->particles.optical_depth);
    EXPECT_FALSE(has_value(urban, "atmosphere.layers.aerosol.g"));
    EXPECT_EQ(layer->scale_height.meters, 2000);
}

}  // namespace
}  // namespace skybake::config
