#include "config/sections/sections.h"

#include <gtest/gtest.h>

#include <limits>

#include "tests/config/noises.h"

namespace skybake::config {
namespace {

using testing::channel_of;
using testing::channel_recipe;
using testing::only_diagnostic;
using testing::parse;
using testing::valid;
using testing::value_at;

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
    EXPECT_EQ(testing::to_string(channel("clamp = false")), testing::to_string(channel("")));
    const auto code = [](const std::string& keys) {
        return only_diagnostic(channel_recipe("type = 'worley'\n" + keys)).code;
    };
    EXPECT_EQ(code("smoothstep = [1.4, 0.8]"), "E0110");
    EXPECT_EQ(code("smoothstep = [1, 1]"), "E0110");
    EXPECT_EQ(code("smoothstep = [0, 1, 2]"), "E0108");
    EXPECT_EQ(code("smoothstep = true"), "E0103");
    EXPECT_EQ(code("clamp = [1, 0]"), "E0113");
    EXPECT_EQ(code("clamp = [0, 1e7]"), "E0110");
    EXPECT_EQ(code("clamp = 1"), "E0103");
}

TEST(NoiseDecoder, ReadsEveryKey) {
    const NoiseChannel channel = channel_of(
        "type = 'perlin_worley'\nfractal = 'billow'\nfeature = 'f2_minus_f1'\n"
        "value_form = 'one_minus_distance_over_sqrt3'\nseed = 3\nremap = [0.1, 0.9, 1, 0]\n"
        "smoothstep = [0.2, 0.7]\ninvert = true\nbias = 0.25\nclamp = [0.1, 0.5]\nfrequencies = "
        "[3]\nworley_frequencies = [5, 6]\n"
        "worley_gains = [2, 1]");
    EXPECT_EQ(testing::to_string(channel),
              "Y 3 0 | [[3, 3, 3]] [1] | [[5, 5, 5], [6, 6, 6]] [2, 1] | 3 2 2 0 3 "
              "[0.1, 0.9, 1, 0] [0.2, 0.7] true 0.25 [0.1, 0.5]");
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

TEST(NoiseDecoder, ChannelsMakeAPicture) {
    for (const char* letters : {"Y", "R", "RGB", "RGBA"}) {
        EXPECT_TRUE(parse(with_channels(letters)).value) << letters;
    }
    for (const char* letters : {"G", "B", "A", "RG", "RA", "RGA", "GBA", "YR", "RGBAY", "YA"}) {
        const Diagnostic diagnostic = only_diagnostic(with_channels(letters));
        EXPECT_EQ(diagnostic.code, "E0129") << letters;
        EXPECT_GT(diagnostic.where.line, 2) << letters;
    }
    EXPECT_EQ(
        only_diagnostic(with_channels("RG")).label,
        "expected R, G, B; type = \"constant\" and value = 0 can stand in for the missing one");
    EXPECT_EQ(only_diagnostic(with_channels("RG")).message, "[noise.n] has channels R, G");
}

TEST(NoiseDecoder, ANoiseHasChannels) {
    for (const char* text : {"[noise.n]\nseed = 1\n", "[noise.n]\nchannels = {}\n"}) {
        const Diagnostic diagnostic = only_diagnostic(text);
        EXPECT_EQ(diagnostic.code, "E0129") << text;
        EXPECT_EQ(diagnostic.message, "[noise.n] has no channels");
        EXPECT_EQ(diagnostic.where.line, 1);
    }
}

TEST(NoiseDecoder, UnknownNamesAreOneError) {
    const Diagnostic channel = only_diagnostic("[noise.n.channels.r]\ntype = 'perlin'\n");
    EXPECT_EQ(channel.code, "E0102");
    EXPECT_EQ(channel.label, "a noise has the channels R, G, B and A, or Y alone");
    const Diagnostic type =
        only_diagnostic(channel_recipe("type = 'perlin_worly'\nfractal = 'fbm'"));
    EXPECT_EQ(type.code, "E0104");
    EXPECT_EQ(type.label, "did you mean `perlin_worley`?");
    const Diagnostic key = only_diagnostic(channel_recipe("type = 'perlin'\noctave = 3"));
    EXPECT_EQ(key.code, "E0102");
    EXPECT_EQ(key.label, "did you mean `octaves`?");
    EXPECT_EQ(only_diagnostic(channel_recipe("frequency = 3")).message,
              "`noise.n.channels.Y.type` is missing");
    EXPECT_EQ(
        only_diagnostic("[noise.n]\nfrequency = 3\n[noise.n.channels.Y]\ntype = 'curl'\n").label,
        "`frequency` belongs in [noise.*.channels.*]");
}

TEST(NoiseDecoder, KeysOfAnotherTypeAreRefused) {
    for (const char* keys :
         {"type = 'perlin'\nfeature = 'f1'", "type = 'worley'\nfractal = 'fbm'",
          "type = 'worley'\nworley_gain = 1", "type = 'perlin'\ncomponent = 'x'",
          "type = 'constant'\nvalue = 1\nfrequency = 3", "type = 'curl'\nvalue = 1"}) {
        EXPECT_EQ(only_diagnostic(channel_recipe(keys)).code, "E0111") << keys;
    }
    EXPECT_EQ(only_diagnostic(channel_recipe("type = 'constant'")).code, "E0105");
}

TEST(NoiseDecoder, PackingsTakeTheirChannels) {
    EXPECT_TRUE(parse(with_channels("RGBA", "pack = 'shape'")).value);
    EXPECT_TRUE(parse(with_channels("RGB", "pack = 'detail'")).value);
    EXPECT_EQ(only_diagnostic(with_channels("RGB", "pack = 'shape'")).code, "E0129");
    const Diagnostic diagnostic = only_diagnostic(with_channels("RGBA", "pack = 'detail'"));
    EXPECT_EQ(diagnostic.code, "E0129");
    EXPECT_EQ(diagnostic.message,
              "`noise.n.pack` packs channels R, G, B, but the noise has R, G, B, A");
    EXPECT_EQ(diagnostic.where.line, 2);
}

TEST(NoiseDecoder, NamesAndTablesAreChecked) {
    EXPECT_EQ(only_diagnostic("[noise.\"a b\".channels.Y]\ntype = 'perlin'\n").code, "E0117");
    EXPECT_EQ(parse("noise = 3\npreset = 'vacuum'").diagnostics.at(0).code, "E0103");
    EXPECT_EQ(only_diagnostic("[noise]\nn = 3\n").code, "E0103");
    EXPECT_EQ(only_diagnostic("[noise.n]\nchannels = 3\n").code, "E0103");
    EXPECT_EQ(only_diagnostic("[noise.n.channels]\nY = 3\n").code, "E0103");
    EXPECT_EQ(only_diagnostic(with_channels("Y", "size = [0, 1, 1]")).code, "E0110");
    EXPECT_EQ(only_diagnostic(with_channels("Y", "size = [1, 1]")).code, "E0108");
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
