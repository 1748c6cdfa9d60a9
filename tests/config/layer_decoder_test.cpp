// Layers of the air: profiles, OPAC's mixtures, and kinds of spheres.
#include <gtest/gtest.h>

#include <string>

#include "config/assets/phase.h"
#include "config/fields/fields.h"
#include "config/optics/aerosol_components.h"
#include "config/presets/presets.h"
#include "config/recipe/init_text.h"
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
    constexpr int kLast = static_cast<int>(AerosolMixture::antarctic);
    ASSERT_EQ(field->choices.size(), std::size_t{kLast + 1});
    for (int mixture = 0; mixture <= kLast; ++mixture)
        EXPECT_FALSE(choice_name(*field, static_cast<AerosolMixture>(mixture)).empty());
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

TEST(AerosolDecoder, ParticlesMayHaveAnOpticalDepth) {
    const std::string drops = "[particles.drops]\neffective_radius = '10 um'\n";
    const Layer layer = layer_of("phase = { mie = 'drops' }\noptical_depth = 0.4\n" + drops);
    EXPECT_NEAR(layer.particles.extinction->per_meter, 0.4 / 2000, 1e-15);
}

TEST(LayerDecoder, ReadsEveryProfile) {
    const Recipe recipe = valid(
        "preset = 'vacuum'\n"
        "[atmosphere.layers.tent]\nprofile = 'tent'\ncenter_altitude = '25 km'\nhalf_width = '15 "
        "km'\n"
        "[atmosphere.layers.slab]\nprofile = 'slab'\nbottom_altitude = '-1 km'\ntop_altitude = "
        "'500 km'\n"
        "[atmosphere.layers.table]\nprofile = 'tabulated'\ntable = [['0 km', 1.0], ['10 km', 0]]\n"
        "phase = 'henyey_greenstein'\ng = -0.5\n");
    const Layer* tent = find_layer(recipe.parameters, "tent");
    ASSERT_TRUE(tent);
    EXPECT_EQ(tent->profile, Profile::tent);
    EXPECT_EQ(tent->center_altitude.meters, 25000);
    EXPECT_EQ(tent->half_width.meters, 15000);
    EXPECT_EQ(tent->phase, Phase::isotropic);
    const Layer* slab = find_layer(recipe.parameters, "slab");
    ASSERT_TRUE(slab);
    EXPECT_EQ(slab->bottom_altitude.meters, -1000);
    EXPECT_EQ(slab->top_altitude.meters, 500000);
    const Layer* table = find_layer(recipe.parameters, "table");
    ASSERT_TRUE(table);
    ASSERT_EQ(table->table.size(), 2u);
    EXPECT_EQ(table->table[1].altitude.meters, 10000);
    EXPECT_EQ(table->table[0].density, 1);
    EXPECT_EQ(table->phase, Phase::henyey_greenstein);
    EXPECT_EQ(table->g, -0.5);
}

TEST(LayerDecoder, ASwitchedOffLayerIsDroppedButChecked) {
    const Recipe recipe =
        valid("preset = 'earth_hillaire'", {"atmosphere.layers.mie.enabled=false"});
    EXPECT_EQ(recipe.parameters.atmosphere.layers.size(), 2u);
    EXPECT_TRUE(has_value(recipe, "atmosphere.layers.mie.enabled"));
    EXPECT_FALSE(has_value(recipe, "atmosphere.layers.mie.g"));
}

TEST(ParticleDecoder, EveryPresetIsParticles) {
    for (const Preset& preset : particle_presets()) {
        const Recipe recipe = valid("preset = 'vacuum'\n[particles.p]\npreset = '" +
                                    std::string(preset.name) + "'\n");
        ASSERT_EQ(recipe.parameters.particles.size(), 1u) << preset.name;
        EXPECT_EQ(recipe.parameters.particles[0].name, "p");
    }
}

TEST(ParticleDecoder, WhatInitWritesBakesThem) {
    for (const Preset& preset : particle_presets()) {
        const Recipe recipe = valid(particle_init_text(preset));
        ASSERT_EQ(recipe.parameters.bakes.size(), 2u) << preset.name;
        const auto& sampling = recipe.parameters.bakes[1].as<PhaseBake>();
        EXPECT_EQ(sampling.content, PhaseContent::inverse_cumulative);
        EXPECT_EQ(sampling.particles, preset.name);
    }
}

TEST(ParticleDecoder, EachDistributionHasItsOwnKeys) {
    const std::string vacuum = "preset = 'vacuum'\n[particles.p]\n";
    const Particles gamma =
        valid(vacuum + "effective_radius = '10 um'\n").parameters.particles.at(0);
    EXPECT_EQ(gamma.sizes, SizeDistribution::gamma);
    EXPECT_EQ(gamma.effective_radius.meters, 10e-6);
    EXPECT_EQ(gamma.effective_variance, 0.1);
    const Particles log_normal =
        valid(vacuum + "sizes = 'log_normal'\nradius = '0.2 um'\ngeometric_deviation = 2\n")
            .parameters.particles.at(0);
    EXPECT_EQ(log_normal.radius.meters, 0.2e-6);
    EXPECT_EQ(log_normal.geometric_deviation, 2);
}

const std::string fog =
    "preset = 'earth_hillaire'\n[particles.drops]\npreset = 'fog'\n[atmosphere.layers.fog]\n"
    "profile = 'slab'\nbottom_altitude = '0 m'\ntop_altitude = '200 m'\n"
    "number_density = '15 /cm3'\n";

TEST(ParticleDecoder, LayersOfParticlesAreNamedInTwoWays) {
    const Recipe table = valid(fog + "phase = { mie = 'drops' }\n");
    const Recipe keys = valid(fog + "phase = 'mie'\nparticles = 'drops'\n");
    EXPECT_EQ(testing::all_parameters(table), testing::all_parameters(keys));
    const Layer* layer = find_layer(table.parameters, "fog");
    ASSERT_TRUE(layer);
    EXPECT_EQ(layer->phase, Phase::mie);
    ASSERT_EQ(layer->particles.kinds.size(), 1u);
    EXPECT_EQ(layer->particles.kinds[0].particles.name, "drops");
    EXPECT_EQ(layer->particles.kinds[0].number_density.per_cubic_meter, 15e6);
    EXPECT_EQ(layer->particles.wavelengths.size(), 3u);
    EXPECT_TRUE(layer->scattering.empty());
}

}  // namespace
}  // namespace skybake::config
