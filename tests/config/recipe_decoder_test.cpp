#include "config/recipe/recipe_decoder.h"
#include "config/sections/cloud.h"
#include "config/sections/noise.h"

#include <gtest/gtest.h>

#include "tests/config/recipes.h"

namespace skybake::config {
namespace {

using testing::parse;
using testing::valid;

TEST(RecipeDecoder, OneWavelengthMakesOneChannel) {
    const Recipe recipe = valid(
        "wavelengths = ['550 nm']\n[atmosphere]\nground_radius = '1 km'\ntop_radius = '2 km'\n"
        "ground_albedo = 0.1\n[atmosphere.layers.a]\nprofile = 'exponential'\nscale_height = '1 "
        "km'\nscattering = '1e-6 "
        "/m'\n");
    EXPECT_EQ(recipe.parameters.wavelengths.size(), 1u);
    EXPECT_EQ(recipe.parameters.wavelengths[0].meters, 550e-9);
    EXPECT_EQ(recipe.parameters.atmosphere.ground_albedo, std::vector<double>{0.1});
    EXPECT_EQ(recipe.parameters.atmosphere.layers.at(0).scattering.size(), 1u);
}

TEST(RecipeDecoder, ThreeIsTheDefault) {
    const Recipe recipe =
        valid("[atmosphere]\nground_radius = '1 km'\ntop_radius = '2 km'\nground_albedo = 0.1\n");
    ASSERT_EQ(recipe.parameters.wavelengths.size(), 3u);
    EXPECT_EQ(recipe.parameters.wavelengths[0].meters, 680e-9);
    EXPECT_EQ(recipe.parameters.wavelengths[2].meters, 440e-9);
    EXPECT_EQ(recipe.parameters.atmosphere.ground_albedo, (std::vector<double>(3, 0.1)));
    EXPECT_TRUE(recipe.parameters.bakes.empty());
}

TEST(RecipeDecoder, ListsForThreeWavelengthsAreRefusedWithTwoWithoutATail) {
    const auto diagnostics =
        parse("preset = 'earth_hillaire'\nwavelengths = ['1 um', '2 um']").diagnostics;
    ASSERT_EQ(diagnostics.size(), 2u);  // the coefficients of air and of ozone
    for (const Diagnostic& diagnostic : diagnostics) EXPECT_EQ(diagnostic.code, "E0108");
}

// Noises and clouds need no sky; bakes of a sky do.
TEST(RecipeDecoder, NoisesAndCloudsNeedNoAtmosphere) {
    const std::string noise = "[noise.n.channels.Y]\ntype = 'worley'\n";
    const std::string volume = "[bake.n]\nasset = 'noise_volume'\nnoise = 'n'\n";
    for (const std::string& text : {noise, noise + volume}) {
        const Recipe recipe = valid(text);
        EXPECT_EQ(recipe.parameters.noises.size(), 1u);
        EXPECT_EQ(recipe.parameters.atmosphere.ground_radius.meters, 0);
        EXPECT_TRUE(recipe.parameters.atmosphere.layers.empty());
    }
    const std::string cloud = "[clouds.c]\nnoise = 'n'\nextent = ['1 m', '1 m', '1 m']\n";
    EXPECT_EQ(valid(noise + cloud).parameters.clouds.size(), 1u);
}

}  // namespace
}  // namespace skybake::config
