#include "config/sections/sections.h"

#include <gtest/gtest.h>

#include <limits>

#include "tests/config/noises.h"

namespace skybake::config {
namespace {

using testing::channel_of;
using testing::channel_recipe;

std::string with_channels(const std::string& letters, const std::string& keys = "") {
    std::string text = "[noise.n]\n" + keys + "\n";
    for (const char letter : letters) {
        text += fmt::format("[noise.n.channels.{}]\ntype = 'worley'\n", letter);
    }
    return text;
}

TEST(NoiseDecoder, HasDefaults) {
    const Recipe recipe = valid(channel_recipe("type = 'worley'"));
    const Noise& noise = recipe.parameters.noises.at(0);
    EXPECT_EQ(noise.name, "n");
    EXPECT_EQ(noise.seed, 0u);
    EXPECT_EQ(noise.size, (std::array<int, 3>{128, 128, 128}));
    EXPECT_EQ(noise.sampling, NoiseSampling::centers);
    EXPECT_EQ(noise.pack, NoisePacking::none);
    const NoiseChannel& channel = noise.channels.at(0);
    EXPECT_EQ(channel.name, "Y");
    EXPECT_EQ(channel.type, NoiseType::worley);
    EXPECT_EQ(channel.feature, WorleyFeature::f1);
    EXPECT_EQ(channel.value_form, WorleyValue::one_minus_distance);
    EXPECT_EQ(channel.seed, 0u);
    EXPECT_EQ(channel.remap, (std::array<double, 4>{0, 1, 0, 1}));
    EXPECT_FALSE(channel.invert);
    EXPECT_EQ(channel.bias, 0.5);
    EXPECT_FALSE(channel.smoothstep);
    constexpr double infinity = std::numeric_limits<double>::infinity();
    EXPECT_EQ(channel.clamp, (std::array<double, 2>{-infinity, infinity}));
}

TEST(NoiseDecoder, ReadsStepsAndClamps) {
    const auto channel = [](const std::string& keys) {
        return channel_of("type = 'worley'\n" + keys);
    };
    EXPECT_EQ(*channel("smoothstep = [0.8, 1.4]").smoothstep, (std::array<double, 2>{0.8, 1.4}));
    EXPECT_EQ(channel("clamp = true").clamp, (std::array<double, 2>{0, 1}));
    EXPECT_EQ(channel("clamp = [-0.5, 2]").clamp, (std::array<double, 2>{-0.5, 2}));
    EXPECT_EQ(channel("clamp = [1, 1]").clamp, (std::array<double, 2>{1, 1}));
    EXPECT_TRUE(channel("clamp = false") == channel(""));
}

TEST(NoiseDecoder, ReadsEveryKey) {
    const NoiseChannel channel = channel_of(
        "type = 'perlin_worley'\nfractal = 'billow'\nfeature = 'f2_minus_f1'\n"
        "value_form = 'one_minus_distance_over_sqrt3'\nseed = 3\nremap = [0.1, 0.9, 1, 0]\n"
        "smoothstep = [0.2, 0.7]\ninvert = true\nbias = 0.25\nclamp = [0.1, 0.5]\nfrequencies = "
        "[3]\nworley_frequencies = [5, 6]\n"
        "worley_gains = [2, 1]");
    NoiseChannel expected;
    expected.name = "Y";
    expected.type = NoiseType::perlin_worley;
    expected.octaves = {{{3, 3, 3}}, {1}};
    expected.worley_octaves = {{{5, 5, 5}, {6, 6, 6}}, {2, 1}};
    expected.fractal = NoiseFractal::billow;
    expected.feature = WorleyFeature::f2_minus_f1;
    expected.value_form = WorleyValue::one_minus_distance_over_sqrt3;
    expected.seed = 3;
    expected.remap = {0.1, 0.9, 1, 0};
    expected.smoothstep = {0.2, 0.7};
    expected.invert = true;
    expected.bias = 0.25;
    expected.clamp = {0.1, 0.5};
    EXPECT_TRUE(channel == expected);
    EXPECT_EQ(channel_of("type = 'curl'\ncomponent = 'z'").component, CurlComponent::z);
    EXPECT_EQ(channel_of("type = 'constant'\nvalue = -0.5").value, -0.5);
}

TEST(NoiseDecoder, ChannelsStandInTheOrderOfPictures) {
    const Recipe recipe = valid(with_channels("ABGR"));
    std::string names;
    for (const NoiseChannel& channel : recipe.parameters.noises.at(0).channels)
        names += channel.name;
    EXPECT_EQ(names, "RGBA");
}

TEST(NoiseDecoder, ValuesKnowWhereTheyComeFrom) {
    const Recipe recipe =
        valid("[noise.n]\npreset = 'nubis_shape'\nseed = 7\n", {"noise.n.channels.R.gain=0.25"});
    EXPECT_EQ(value_at(recipe, "noise.n.seed").origin, "test.toml:3");
    EXPECT_EQ(value_at(recipe, "noise.n.sampling").origin, "preset nubis_shape");
    EXPECT_EQ(value_at(recipe, "noise.n.channels.R.frequency").origin, "preset nubis_shape");
    EXPECT_EQ(value_at(recipe, "noise.n.channels.R.gain").origin,
              "--set `noise.n.channels.R.gain=0.25`");
    EXPECT_EQ(value_at(recipe, "noise.n.channels.R.gains").origin, "derived");
    EXPECT_EQ(value_at(recipe, "noise.n.channels.R.gains").canonical, "[1, 0.25, 0.0625]");
    EXPECT_EQ(value_at(recipe, "noise.n.channels.R.frequencies").canonical, "[8, 16, 32]");
    EXPECT_TRUE(value_at(recipe, "noise.n.channels.R.frequency").only_shown);
}

}  // namespace
}  // namespace skybake::config
