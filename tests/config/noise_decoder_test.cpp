// Keys of noise, of noise that moves and that is displaced, and of volumes that are frames of a loop.
#include "config/sections/sections.h"

#include <gtest/gtest.h>

#include <rapidcheck.h>

#include "config/assets/asset_kind.h"
#include "config/assets/noise_volume.h"
#include "config/sections/frames.h"
#include "tests/config/noises.h"

namespace skybake::config {
namespace {

using namespace testing;
using Triple = std::array<int, 3>;

TEST(NoiseDecoder, ReadsEveryKey) {
    const NoiseChannel channel = channel_of(
        "type = 'perlin_worley'\nfractal = 'billow'\nfeature = 'f2_minus_f1'\n"
        "value_form = 'one_minus_distance_over_sqrt3'\nseed = 3\nremap = [0.1, 0.9, 1, 0]\n"
        "smoothstep = [0.2, 0.7]\ninvert = true\nbias = 0.25\nclamp = [0.1, 0.5]\nfrequencies = "
        "[3]\nworley_frequencies = [5, 6]\nworley_gains = [2, 1]\nwarp_strength = -0.2\n"
        "warp_by = 'gradient'\nwarp_frequency = [2, 3, 4]\nwarp_octaves = 2\nwarp_gain = 0.25");
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
    expected.warp_strength = -0.2;
    expected.warp_by = NoiseWarp::gradient;
    expected.warp_octaves = {{{2, 3, 4}, {4, 6, 8}}, {1, 0.25}};
    EXPECT_TRUE(channel == expected);
    EXPECT_EQ(channel_of("type = 'curl'\ncomponent = 'z'").component, CurlComponent::z);
    EXPECT_EQ(channel_of("type = 'constant'\nvalue = -0.5").value, -0.5);
}

TEST(NoiseDecoder, ChannelsStandInTheOrderOfPictures) {
    std::string text, names;
    for (const char letter : {'A', 'B', 'G', 'R'})
        text += fmt::format("[noise.n.channels.{}]\ntype = 'worley'\n", letter);
    const Recipe recipe = valid(text);
    for (const NoiseChannel& channel : recipe.parameters.noises.at(0).channels)
        names += channel.name;
    EXPECT_EQ(names, "RGBA");
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

TEST(NoiseTime, HasItsKeys) {
    const Noise given =
        valid(channel_recipe("type = 'perlin'") +
              "[noise.n]\nperiod = 1\ntime = -7\ntime_cells = 3\ndrift = [1, -2, 0]")
            .parameters.noises.at(0);
    EXPECT_EQ(given.period, 1);
    EXPECT_EQ(given.time, -7);
    EXPECT_EQ(given.time_cells, 3);
    EXPECT_EQ(given.drift, (Triple{1, -2, 0}));
}

// --- Frames -------------------------------------------------------------------------------------

std::string frames_recipe(const std::string& keys, const std::string& noise) {
    return volume_recipe("size = [8, 8, 8]\n" + keys, "type = 'perlin'\nfrequency = 2") +
           "[noise.n]\n" + noise + "\n";
}

TEST(Frames, AreAnAssetEach) {
    const Recipe recipe = valid(frames_recipe("frames = 12", "period = 12\ntime = 5"));
    const std::vector<Bake>& bakes = recipe.parameters.bakes;
    ASSERT_EQ(bakes.size(), 12u);
    const std::string whole = bakes[0].name.substr(0, bakes[0].name.size() - 5);
    EXPECT_EQ(bakes[0].name, whole + "_0001");
    EXPECT_EQ(bakes[11].name, whole + "_0012");
    for (int i = 0; i < 12; ++i) {
        const int frame = frame_of(recipe.parameters, bakes[static_cast<std::size_t>(i)]);
        EXPECT_EQ(frame, i + 1);
        EXPECT_EQ(at_frame(recipe.parameters, frame).noises[0].time, 5 + i);
    }
    EXPECT_EQ(at_frame(recipe.parameters, 0).noises[0].time, 5);
}

TEST(Frames, OfOneNumberAreOneAsset) {
    const Recipe recipe = valid(frames_recipe("frames = 12\nframe = 7", "period = 12"));
    ASSERT_EQ(recipe.parameters.bakes.size(), 1u);
    EXPECT_EQ(frame_of(recipe.parameters, recipe.parameters.bakes[0]), 7);
}

// Only a first frame as its files carry it places the others.
TEST(Frames, AreCountedByTheFirstWithAScene) {
    const auto frames = [](const std::string& name, int frame, const std::string& formats) {
        std::string text = frames_recipe(
            fmt::format("frames = 4\nframe = {}\nformats = [{}]", frame, formats), "period = 4");
        text.replace(text.find("bake.n"), 6, "bake." + name);
        return files_of(valid(text).parameters.bakes.at(0)).frames;
    };
    EXPECT_EQ(frames("n_0001", 1, "'vdb', 'usda'"), 4);
    EXPECT_EQ(frames("n_0001", 1, "'vdb'"), 0);
    EXPECT_EQ(frames("n_0001", 2, "'vdb', 'usda'"), 0);
    EXPECT_EQ(frames("n", 1, "'vdb', 'usda'"), 0);
}

}  // namespace
}  // namespace skybake::config
