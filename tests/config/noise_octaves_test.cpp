#include "config/sections/noise.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include "tests/config/noises.h"

namespace skybake::config {
namespace {

using testing::channel_of;
using testing::channel_recipe;
using Frequencies = std::vector<std::array<int, 3>>;
using Gains = std::vector<double>;

TEST(NoiseOctaves, AreASeries) {
    const NoiseChannel channel = channel_of(
        "type = 'perlin'\nfrequency = [3, 1, 2]\noctaves = 3\nlacunarity = 3\ngain = 0.25");
    EXPECT_EQ(channel.octaves.frequencies, (Frequencies{{3, 1, 2}, {9, 3, 6}, {27, 9, 18}}));
    EXPECT_EQ(channel.octaves.gains, (Gains{1, 0.25, 0.0625}));
    EXPECT_TRUE(channel.worley_octaves.frequencies.empty());
}

TEST(NoiseOctaves, HaveDefaults) {
    const NoiseChannel channel = channel_of("type = 'perlin_worley'");
    EXPECT_EQ(channel.octaves.frequencies, (Frequencies{{4, 4, 4}}));
    EXPECT_EQ(channel.octaves.gains, Gains{1});
    EXPECT_EQ(channel.worley_octaves.frequencies,
              (Frequencies{{4, 4, 4}, {8, 8, 8}, {16, 16, 16}}));
    EXPECT_EQ(channel.worley_octaves.gains, (Gains{1, 0.5, 0.25}));
    EXPECT_EQ(channel_of("type = 'curl'\noctaves = 2").octaves.gains, (Gains{1, 0.5}));
    EXPECT_TRUE(channel_of("type = 'constant'\nvalue = 1").octaves.frequencies.empty());
}

TEST(NoiseOctaves, AreAsManyAsFrequenciesOrGains) {
    EXPECT_EQ(channel_of("type = 'worley'\nfrequencies = [8, 32, 56]").octaves.gains,
              (Gains{1, 0.5, 0.25}));
    EXPECT_EQ(channel_of("type = 'worley'\ngains = [0.75, 0.25]").octaves.frequencies,
              (Frequencies{{4, 4, 4}, {8, 8, 8}}));
    EXPECT_EQ(channel_of("type = 'perlin_worley'\nworley_gains = [1, 2]")
                  .worley_octaves.frequencies.size(),
              2u);
}

TEST(NoiseOctaves, GainsMayBeZeroButNotAll) {
    EXPECT_EQ(channel_of("type = 'worley'\noctaves = 2\ngain = 0").octaves.gains, (Gains{1, 0}));
    EXPECT_EQ(channel_of("type = 'worley'\ngains = [0, 1]").octaves.gains, (Gains{0, 1}));
}

TEST(NoiseOctaves, SixteenFit) {
    EXPECT_EQ(channel_of("type = 'perlin'\nfrequency = 1\nlacunarity = 2\noctaves = 16")
                  .octaves.frequencies.back()[0],
              32768);
}

TEST(NoiseOctaves, FollowTheirDefinition) {
    EXPECT_TRUE(rc::check("frequency * lacunarity^i, or an error", [] {
        const int frequency = *rc::gen::inRange(1, 1048577);
        const int lacunarity = *rc::gen::inRange(1, 17);
        const int octaves = *rc::gen::inRange(1, 17);
        const auto outcome = testing::parse(channel_recipe(
            fmt::format("type = 'curl'\nfrequency = {}\nlacunarity = {}\noctaves = {}", frequency,
                        lacunarity, octaves)));
        long double expected = frequency;
        bool fits = true;
        for (int i = 1; i < octaves; ++i) fits = fits && (expected *= lacunarity) <= 1048576;
        RC_ASSERT(outcome.value.has_value() == fits);
        if (!fits) {
            RC_ASSERT(outcome.diagnostics.size() == 1u && outcome.diagnostics[0].code == "E0128");
            return;
        }
        const NoiseOctaves& result = outcome.value->parameters.noises.at(0).channels.at(0).octaves;
        RC_ASSERT(result.frequencies.size() == static_cast<std::size_t>(octaves));
        RC_ASSERT(result.gains.size() == static_cast<std::size_t>(octaves));
        RC_ASSERT(static_cast<long double>(result.frequencies.back()[1]) == expected);
    }));
}

}  // namespace
}  // namespace skybake::config
