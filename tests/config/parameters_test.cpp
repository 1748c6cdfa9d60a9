#include <gtest/gtest.h>

#include "config/assets/cloud_volume.h"
#include "config/assets/noise_volume.h"
#include "config/presets/presets.h"
#include "config/recipe/recipe.h"
#include "config/sections/noise.h"
#include "tests/config/recipes.h"

namespace skybake::config {
namespace {

// parameters_toml of recipe.h.

std::string text_of(const Recipe& recipe, const std::vector<std::string>& patterns) {
    return parameters_toml(recipe, patterns);
}

TEST(ParametersToml, PrintsWhatThePatternsName) {
    const Recipe recipe = valid("preset = 'earth_hillaire'\n[bake.transmittance]\n");
    EXPECT_EQ(text_of(recipe, {"wavelengths", "atmosphere.ground_radius",
                               "atmosphere.layers.*.extinction", "bake.transmittance.*"}),
              "wavelengths = [\"680 nm\", \"550 nm\", \"440 nm\"]\n"
              "\n[atmosphere]\n"
              "ground_radius = \"6360000 m\"\n"
              "\n[atmosphere.layers.mie]\n"
              "extinction = [\"4.44e-06 /m\", \"4.44e-06 /m\", \"4.44e-06 /m\"]\n"
              "\n[atmosphere.layers.ozone]\n"
              "extinction = [\"6.5e-07 /m\", \"1.881e-06 /m\", \"8.5e-08 /m\"]\n"
              "\n[atmosphere.layers.rayleigh]\n"
              "extinction = [\"5.802e-06 /m\", \"1.3558e-05 /m\", \"3.31e-05 /m\"]\n"
              "\n[bake.transmittance]\n"
              "asset = \"transmittance\"\n"
              "size = [256, 64]\n"
              "content = \"transmittance\"\n"
              "mapping = \"bruneton\"\n"
              "formats = [\"exr\"]\n"
              "pixel_type = \"float\"\n"
              "layout = \"stack\"\n"
              "flip = false\n"
              "mips = 1\n"
              "compression = \"zip\"\n"
              "vdb_compression = \"blosc\"\n"
              "ktx2_compression = \"zstd\"\n");
    EXPECT_EQ(text_of(recipe, {}), "");
    EXPECT_EQ(text_of(recipe, {"nothing", "atmosphere"}), "");
}

TEST(ParametersToml, LeavesOutWhereValuesComeFrom) {
    const Recipe plain = valid("preset = 'earth_hillaire'");
    const Recipe roundabout = valid(
        "format = 1\npreset = 'earth_hillaire'\n[atmosphere.layers.mie]\n"
        "absorption = '4.44e-7 /m'\nenabled = true\n"
        "[atmosphere.layers.haze]\nenabled = false\n",
        {"atmosphere.layers.mie.extinction=4.44e-6 /m"});
    EXPECT_EQ(testing::all_parameters(roundabout), testing::all_parameters(plain));
}

// An unrelated change must not touch a file's bytes.
TEST(ParametersToml, IsUntouchedByUnrelatedChanges) {
    const std::vector<std::string> patterns = {"atmosphere.layers.*.extinction"};
    EXPECT_EQ(text_of(valid("preset = 'earth_hillaire'"), patterns),
              text_of(valid("preset = 'earth_hillaire'\n[bake.multiple_scattering]\n",
                            {"atmosphere.ground_albedo=1", "atmosphere.layers.mie.g=0"}),
                      patterns));
}

TEST(ParametersToml, QuotesNamesThatNeedIt) {
    const Recipe recipe = valid(
        "preset = 'vacuum'\n[atmosphere.layers.\"a.b\"]\nprofile = 'slab'\n"
        "bottom_altitude = '0 m'\ntop_altitude = '1 m'\n");
    EXPECT_EQ(text_of(recipe, {"atmosphere.layers.*.profile"}),
              "[atmosphere.layers.\"a.b\"]\nprofile = \"slab\"\n");
}

std::vector<std::string> texts(std::string_view before, std::string_view after) {
    std::vector<std::string> result;
    for (const ParameterChange& change : parameter_changes(before, after)) {
        result.push_back(change_text(change));
    }
    return result;
}

TEST(ParameterChanges, AreNamedByPath) {
    EXPECT_EQ(texts("[clouds.cumulus]\nthreshold = 0.35\ncoverage = 1\n",
                    "[clouds.cumulus]\nthreshold = 0.4\ncoverage = 1\n"),
              std::vector<std::string>{"clouds.cumulus.threshold 0.35 → 0.4"});
}

TEST(ParameterChanges, WhatComesAndGoes) {
    EXPECT_EQ(texts("[a]\nb = \"8 km\"\n", "[a]\n\"sea fog\" = [1, 2]\n"),
              (std::vector<std::string>{"a.\"sea fog\" none → [1, 2]", "a.b \"8 km\" → none"}));
}

TEST(ParameterChanges, OfEqualOrUnreadableTexts) {
    EXPECT_EQ(texts("a = 1\n", "# words\na=1"), std::vector<std::string>{});
    EXPECT_EQ(texts("a = = 1\n", "a = 1\n"), std::vector<std::string>{"a none → 1"});
}

// Tests what a [bake.NAME] takes from the cloud or the noise of its name.

const std::string noise = "[noise.n.channels.Y]\ntype = 'worley'\nfrequency = 2\noctaves = 1\n";
const std::string cloud =
    noise + "[clouds.c]\nnoise = 'n'\nextent = ['2 km', '2 km', '1 km']\nsize = [16, 16, 8]\n";

TEST(NamedBakes, AreTheVolumeOfTheCloudOrTheNoise) {
    EXPECT_EQ(all_parameters(valid(cloud + "[bake.c]\n")),
              all_parameters(valid(
                  cloud + "[bake.c]\nasset = 'cloud_volume'\ncloud = 'c'\nsize = [16, 16, 8]\n")));
    EXPECT_EQ(all_parameters(valid(cloud + "[bake.c]\nasset = 'cloud_volume'\n")),
              all_parameters(valid(cloud + "[bake.c]\n")));
    const Recipe of_noise = valid(noise + "[bake.n]\nsize = [16, 16, 16]\n");
    EXPECT_EQ(of_noise.parameters.bakes.at(0).as<NoiseVolumeBake>().noise, "n");
    EXPECT_EQ(testing::value_at(valid(cloud + "[bake.c]\n"), "bake.c.cloud").origin, "test.toml:9");
}

TEST(NamedBakes, HaveTheSizeOfThePreset) {
    for (const Preset& preset : cloud_presets()) {
        const std::string name(preset.name);
        const auto outcome = parse("[clouds.c]\npreset = '" + name + "'\n[bake.c]\n");
        ASSERT_TRUE(outcome.value) << name;
        EXPECT_TRUE(outcome.diagnostics.empty()) << name;
        EXPECT_GE(outcome.value->parameters.bakes.at(0).as<CloudVolumeBake>().size[0], 128) << name;
    }
    const std::string given = cloud + "[bake.c]\nvoxel_size = '100 m'\n";
    EXPECT_EQ(valid(given).parameters.bakes.at(0).as<CloudVolumeBake>().size,
              (std::array{20, 20, 10}));
}

TEST(NamedBakes, HaveTheCoverOfTheCloud) {
    const auto cover = [](const std::string& text) {
        return valid(text).parameters.bakes.at(0).as<CloudVolumeBake>().cover;
    };
    EXPECT_FALSE(cover(cloud + "[bake.c]\n"));
    EXPECT_EQ(cover(cloud + "cover = '40 %'\n[bake.c]\n"), 0.4);
    EXPECT_EQ(cover(cloud + "cover = '40 %'\n[bake.c]\ncover = 0.3\n"), 0.3);
    // In place of a preset's coverage.
    const Recipe recipe = valid("[clouds.c]\npreset = 'cirrus'\ncover = 0.3\n[bake.c]\n");
    EXPECT_EQ(recipe.parameters.clouds.at(0).coverage, 1);
    EXPECT_EQ(recipe.parameters.bakes.at(0).as<CloudVolumeBake>().cover, 0.3);
}

TEST(RecipeDecoder, ListsForThreeWavelengthsAreRefusedWithTwoWithoutATail) {
    const auto diagnostics =
        parse("preset = 'earth_hillaire'\nwavelengths = ['1 um', '2 um']").diagnostics;
    ASSERT_EQ(diagnostics.size(), 2u);  // the coefficients of air and of ozone
    for (const Diagnostic& diagnostic : diagnostics) EXPECT_EQ(diagnostic.code, "E0108");
}

}  // namespace
}  // namespace skybake::config
