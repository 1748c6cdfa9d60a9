#include <gtest/gtest.h>

#include "config/sections/cloud.h"
#include "config/sections/noise.h"
#include "tests/config/recipes.h"

namespace skybake::config {
namespace {

const std::string plain_cloud = "[clouds.c]\npreset = 'stratocumulus'\n";
const std::string bake_of_it =
    "[bake.c]\nasset = 'cloud_volume'\ncloud = 'c'\nsize = [512, 512, 32]\n";

TEST(SectionPresetMerge, PresetsOfCloudsBringTheirNoises) {
    const Recipe alone = valid(plain_cloud + bake_of_it);
    const Recipe written = valid(
        "[noise.shape]\npreset = 'nubis_layer'\npack = 'shape'\n[noise.detail]\n"
        "preset = 'nubis_detail'\npack = 'detail'\n" +
        plain_cloud + bake_of_it);
    ASSERT_EQ(alone.parameters.noises.size(), 2u);
    EXPECT_TRUE(alone.parameters.noises == written.parameters.noises);
    const Recipe thesis = valid("[clouds.c]\npreset = 'thesis'\n");
    EXPECT_EQ(thesis.parameters.noises.at(0).channels.size(), 4u);
    EXPECT_EQ(thesis.parameters.noises.at(0).pack, NoisePacking::none);
}

TEST(SectionPresetMerge, TheRecipesOwnNoiseStays) {
    const Recipe other =
        valid("[noise.shape.channels.Y]\ntype = 'worley'\n" + plain_cloud + "detail = ''\n");
    ASSERT_EQ(other.parameters.noises.size(), 1u);
    EXPECT_EQ(other.parameters.noises[0].channels.size(), 1u);
    EXPECT_EQ(other.parameters.noises[0].pack, NoisePacking::none);
    // Keys alone are laid over what the preset brings, be they in the recipe or in --set.
    for (const Recipe& seeded : {valid(plain_cloud + "[noise.shape]\nseed = 7\n"),
                                 valid(plain_cloud, {"noise.shape.seed=7"})}) {
        ASSERT_EQ(seeded.parameters.noises.size(), 2u);
        const Noise& shape = seeded.parameters.noises[1];
        EXPECT_EQ(shape.name, "shape");
        EXPECT_EQ(shape.seed, 7u);
        EXPECT_EQ(shape.channels.size(), 4u);
    }
    EXPECT_EQ(valid("[clouds.a]\npreset = 'stratus'\n[clouds.b]\npreset = 'cirrus'\n")
                  .parameters.noises.size(),
              3u)
        << "shape and detail of one, and tufts of the other";
}

// Clouds whose presets bring different noises under one name do not share the first one's.
TEST(SectionPresetMerge, NoisesOfTwoPresetsDoNotCollide) {
    const std::string stratus = "[clouds.high]\npreset = 'stratus'\n";
    const std::string thesis = "[clouds.low]\npreset = 'thesis'\n";
    for (const std::string& text : {stratus + thesis, thesis + stratus}) {
        const Recipe both = valid(text);
        ASSERT_EQ(both.parameters.noises.size(), 3u) << "detail, shape and shape_low";
        EXPECT_EQ(both.parameters.noises[1].name, "shape");
        EXPECT_EQ(both.parameters.noises[2].name, "shape_low");
        EXPECT_EQ(both.parameters.clouds.at(0).noise, "shape");
        EXPECT_EQ(both.parameters.clouds.at(1).noise, "shape_low");
        const Recipe alone = valid(thesis);
        EXPECT_EQ(both.parameters.noises[2].channels.size(),
                  alone.parameters.noises.at(0).channels.size());
        EXPECT_EQ(both.parameters.noises[2].pack, alone.parameters.noises.at(0).pack);
        EXPECT_NE(both.parameters.noises[1].pack, both.parameters.noises[2].pack);
    }
    // A noise of the recipe serves all that name it.
    const Recipe shared =
        valid("[noise.shape]\npreset = 'nubis_shape'\npack = 'shape'\n" + stratus + thesis);
    EXPECT_EQ(shared.parameters.clouds.at(1).noise, "shape");
    // The second noise is set as any other.
    const Recipe seeded = valid(stratus + thesis + "[noise.shape_low]\nseed = 9\n");
    EXPECT_EQ(seeded.parameters.noises.at(2).seed, 9u);
    EXPECT_EQ(seeded.parameters.noises.at(2).pack, NoisePacking::none);
}

}  // namespace
}  // namespace skybake::config
