#include <gtest/gtest.h>
#include <rapidcheck.h>

#include "config/sections/noise.h"
#include "tests/config/noises.h"

namespace skybake::config {
namespace {

using Frequencies = std::vector<std::array<int, 3>>;
using Gains = std::vector<double>;
using Triple = std::array<int, 3>;
using testing::channel_of;
using testing::channel_recipe;

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

TEST(OctaveSampling, CellsNeedFourVoxels) {
    EXPECT_FALSE(is_coarse({8, 8, 8}, {32, 32, 32}));
    EXPECT_TRUE(is_coarse({8, 8, 9}, {32, 32, 32}));
    EXPECT_TRUE(is_coarse({8, 8, 8}, {31, 32, 32}));
    EXPECT_FALSE(is_coarse({8, 8, 8}, {32, 32, 1})) << "a picture has no cells along z";
    EXPECT_TRUE(is_coarse({1048576, 1, 1}, {16384, 16384, 16384}));
}

TEST(OctaveSampling, PerlinNoiseDiesAtTheLattice) {
    const Triple cube{32, 32, 32};
    EXPECT_FALSE(is_zero_everywhere({32, 32, 32}, cube, NoiseSampling::centers));
    EXPECT_TRUE(is_zero_everywhere({64, 64, 64}, cube, NoiseSampling::centers));
    EXPECT_TRUE(is_zero_everywhere({32, 32, 32}, cube, NoiseSampling::corners));
    EXPECT_FALSE(is_zero_everywhere({16, 32, 32}, cube, NoiseSampling::corners));
    EXPECT_FALSE(is_zero_everywhere({32, 32, 32}, cube, NoiseSampling::slices_at_corners));
    EXPECT_TRUE(is_zero_everywhere({64, 64, 32}, cube, NoiseSampling::slices_at_corners));
    EXPECT_TRUE(is_zero_everywhere({1, 1, 1}, {1, 1, 1}, NoiseSampling::corners));
    EXPECT_FALSE(is_zero_everywhere({1, 1, 1}, {1, 1, 1}, NoiseSampling::centers));
    EXPECT_TRUE(is_zero_everywhere({2, 2, 2}, {1, 1, 1}, NoiseSampling::centers));
}

// Against the definition, voxel by voxel and axis by axis.
bool by_definition(const Triple& frequency, const Triple& size, NoiseSampling sampling) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const bool corners = sampling == NoiseSampling::corners ||
                             (sampling == NoiseSampling::slices_at_corners && axis == 2);
        for (long i = 0; i < size[axis]; ++i) {
            const long numerator =
                corners ? 2 * i * frequency[axis] : (2 * i + 1) * frequency[axis];
            if (numerator % (2L * size[axis]) != 0) return false;
        }
    }
    return true;
}

TEST(OctaveSampling, AgreesWithEveryVoxel) {
    EXPECT_TRUE(rc::check("zero everywhere, by definition", [] {
        const auto sampling = static_cast<NoiseSampling>(*rc::gen::inRange(0, 3));
        Triple size{};
        Triple frequency{};
        for (std::size_t axis = 0; axis < 3; ++axis) {
            size[axis] = *rc::gen::inRange(1, 40);
            // Half of all frequencies are multiples of the size, where it happens.
            const int factor = *rc::gen::inRange(1, 5);
            frequency[axis] =
                *rc::gen::arbitrary<bool>() ? factor * size[axis] : *rc::gen::inRange(1, 100);
        }
        RC_ASSERT(is_zero_everywhere(frequency, size, sampling) ==
                  by_definition(frequency, size, sampling));
    }));
}

}  // namespace
}  // namespace skybake::config
