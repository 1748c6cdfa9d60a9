#include "config/sections/sections.h"

#include <gtest/gtest.h>

#include <string>

#include "config/assets/phase.h"
#include "config/presets/presets.h"
#include "config/recipe/init_text.h"
#include "tests/config/recipes.h"

namespace skybake::config {
namespace {

const std::string fog =
    "preset = 'earth_hillaire'\n[particles.drops]\npreset = 'fog'\n[atmosphere.layers.fog]\n"
    "profile = 'slab'\nbottom_altitude = '0 m'\ntop_altitude = '200 m'\n"
    "number_density = '15 /cm3'\n";

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

TEST(ParticleDecoder, LayersOfParticlesAreNamedInTwoWays) {
    const Recipe table = valid(fog + "phase = { mie = 'drops' }\n");
    const Recipe keys = valid(fog + "phase = 'mie'\nparticles = 'drops'\n");
    const Recipe path = valid(fog, {"atmosphere.layers.fog.phase.mie=\"drops\""});
    EXPECT_EQ(testing::all_parameters(table), testing::all_parameters(keys));
    EXPECT_EQ(testing::all_parameters(table), testing::all_parameters(path));
    const Layer* layer = find_layer(table.parameters, "fog");
    ASSERT_TRUE(layer);
    EXPECT_EQ(layer->phase, Phase::mie);
    ASSERT_EQ(layer->particles.kinds.size(), 1u);
    EXPECT_EQ(layer->particles.kinds[0].particles.name, "drops");
    EXPECT_EQ(layer->particles.kinds[0].number_density.per_cubic_meter, 15e6);
    EXPECT_EQ(layer->particles.wavelengths.size(), 3u);
    EXPECT_TRUE(layer->scattering.empty());
    EXPECT_FALSE(has_value(table, "atmosphere.layers.fog.scattering"));
    EXPECT_EQ(value_at(table, "atmosphere.layers.fog.particles").canonical, "\"drops\"");
    EXPECT_EQ(value_at(table, "atmosphere.layers.fog.number_density").canonical,
              "\"15000000 /m3\"");
}

// A preset's layer made of particles instead: nothing of the preset's is left to contradict them.
TEST(ParticleDecoder, ReplaceWhatAPresetsLayerIs) {
    for (const char* phase :
         {"phase = { mie = 'haze' }\n", "phase = 'mie'\nparticles = 'haze'\n"}) {
        const Recipe recipe =
            valid(std::string("preset = 'earth_hillaire'\n[particles.haze]\npreset = 'haze'\n"
                              "[atmosphere.layers.mie]\nnumber_density = '2e3 /cm3'\n") +
                  phase);
        const Layer* layer = find_layer(recipe.parameters, "mie");
        ASSERT_TRUE(layer);
        EXPECT_EQ(layer->phase, Phase::mie);
        EXPECT_EQ(layer->scale_height.meters, 1200);
        EXPECT_FALSE(has_value(recipe, "atmosphere.layers.mie.g"));
    }
}

TEST(ParticleDecoder, TheirParametersAreARecipe) {
    const Recipe recipe = valid(fog +
                                "phase = { mie = 'drops' }\n[bake.p]\nasset = 'phase'\n"
                                "particles = 'drops'\n");
    const std::string text = testing::all_parameters(recipe);
    EXPECT_EQ(testing::all_parameters(valid(text)), text);
}

TEST(PhaseDecoder, NamesParticlesOrALayer) {
    const std::string bake = fog + "phase = 'mie'\nparticles = 'drops'\n[bake.phase]\n";
    const Recipe recipe = valid(bake + "particles = 'drops'\n");
    const auto& phase = recipe.parameters.bakes.back().as<PhaseBake>();
    EXPECT_EQ(phase.particles, "drops");
    EXPECT_EQ(phase.size, 1024);
    EXPECT_EQ(phase.spacing, PhaseSpacing::best);
}

}  // namespace
}  // namespace skybake::config
