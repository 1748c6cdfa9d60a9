// Tests what a [bake.NAME] takes from the cloud or the noise of its name.
#include "config/recipe/named_bakes.h"

#include <gtest/gtest.h>

#include "config/assets/cloud_volume.h"
#include "config/assets/noise_volume.h"
#include "config/presets/presets.h"
#include "tests/config/recipes.h"

namespace skybake::config {
namespace {

using testing::all_parameters;
using testing::parse;
using testing::valid;

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
    EXPECT_EQ(parse(cloud + "cover = 0.4\ncoverage = 0.5\n").diagnostics.at(0).code, "E0109");
    // In place of a preset's coverage.
    const Recipe recipe = valid("[clouds.c]\npreset = 'cirrus'\ncover = 0.3\n[bake.c]\n");
    EXPECT_EQ(recipe.parameters.clouds.at(0).coverage, 1);
    EXPECT_EQ(recipe.parameters.bakes.at(0).as<CloudVolumeBake>().cover, 0.3);
}

struct Mistake {
    const char* text;
    const char* code;
    const char* label;
};

TEST(NamedBakes, MistakesGetOneMessage) {
    const Mistake mistakes[] = {
        {"[noise.c]\npreset = 'billows'\n[clouds.c]\npreset = 'cumulus_humilis'\n[bake.c]\n",
         "E0118", "add asset = \"cloud_volume\" or asset = \"noise_volume\""},
        {"[bake.c]\npreset = 'cumulus_humilis'\n[clouds.c]\nasset = 'cloud_volume'\ncloud = 'c'\n",
         "E0102", "`preset` of clouds belongs in [clouds.c]"},
        {"[cloud.c]\npreset = 'cirrus'\n[bake.c]\nasset = 'cloud_volume'\ncloud = 'c'\n"
         "size = [64, 64, 16]\n",
         "E0102", "did you mean `clouds`?"},
    };
    for (const Mistake& mistake : mistakes) {
        const auto diagnostics = parse(mistake.text).diagnostics;
        ASSERT_EQ(diagnostics.size(), 1U) << mistake.text;
        EXPECT_EQ(diagnostics[0].code, mistake.code);
        EXPECT_EQ(diagnostics[0].label, mistake.label);
        EXPECT_GT(diagnostics[0].where.line, 0);
    }
}

TEST(NamedBakes, TowersOutsideTheTileOrAboveItsTopWarn) {
    const auto warnings = [](const std::string& foot, const std::string& height) {
        return testing::codes_and_places(
            parse(cloud + "[clouds.c.towers.0]\nshape = 'dome'\namplitude = 1\nfoot = " + foot +
                  "\nsize = ['1 km', '1 km', '" + height + "']\n")
                .diagnostics);
    };
    using Codes = std::vector<std::string>;
    EXPECT_EQ(warnings("['1 km', '1 km', '-1 km']", "2 km"), Codes{});
    EXPECT_EQ(warnings("['30 km', '1 km', '0 m']", "1 km"), Codes{"W0217 12:8"});
    EXPECT_EQ(warnings("['1 km', '1 km', '0 m']", "9 km"), Codes{"W0217 13:8"});
}

}  // namespace
}  // namespace skybake::config
