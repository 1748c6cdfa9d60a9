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
    // In place of a preset's coverage.
    const Recipe recipe = valid("[clouds.c]\npreset = 'cirrus'\ncover = 0.3\n[bake.c]\n");
    EXPECT_EQ(recipe.parameters.clouds.at(0).coverage, 1);
    EXPECT_EQ(recipe.parameters.bakes.at(0).as<CloudVolumeBake>().cover, 0.3);
}

}  // namespace
}  // namespace skybake::config
