// Keys of noise that moves and noise that is displaced, and of volumes that are frames of a loop.
#include <gtest/gtest.h>

#include "config/assets/asset_kind.h"
#include "config/assets/noise_volume.h"
#include "config/sections/frames.h"
#include "tests/config/noises.h"

namespace skybake::config {
namespace {

using testing::channel_of;
using testing::volume_recipe;

TEST(NoiseWarp, IsNoneUnlessItHasAStrength) {
    const NoiseChannel plain = channel_of("type = 'alligator'");
    EXPECT_EQ(plain.warp_strength, 0);
    EXPECT_TRUE(plain.warp_octaves.frequencies.empty());
    const NoiseChannel warped = channel_of(
        "type = 'perlin'\nwarp_strength = -0.2\nwarp_by = 'gradient'\nwarp_frequency = [2, 3, 4]\n"
        "warp_octaves = 2\nwarp_gain = 0.25");
    EXPECT_EQ(warped.warp_strength, -0.2);
    EXPECT_EQ(warped.warp_by, NoiseWarp::gradient);
    EXPECT_EQ(warped.warp_octaves.frequencies,
              (std::vector<std::array<int, 3>>{{2, 3, 4}, {4, 6, 8}}));
    EXPECT_EQ(warped.warp_octaves.gains, (std::vector<double>{1, 0.25}));
}

TEST(NoiseWarp, OfCurlyAlligatorIsAQuarterOfACellByDefault) {
    const NoiseChannel curly = channel_of("type = 'curly_alligator'\nfrequency = [5, 4, 2]");
    EXPECT_EQ(curly.warp_strength, 0.05);
    EXPECT_EQ(curly.warp_by, NoiseWarp::curl);
    EXPECT_EQ(curly.warp_octaves.frequencies, (std::vector<std::array<int, 3>>{{4, 4, 4}}));
    EXPECT_EQ(channel_of("type = 'curly_alligator'\nwarp_strength = 0").warp_strength, 0);
}

Noise noise_of(const std::string& keys) {
    return valid("[noise.n]\n" + keys + "\n[noise.n.channels.Y]\ntype = 'perlin'\n")
        .parameters.noises.at(0);
}

TEST(NoiseTime, IsNoneUnlessThereIsAPeriod) {
    EXPECT_EQ(noise_of("").period, 0);
    const Noise moving = noise_of("period = 48");
    EXPECT_EQ(moving.period, 48);
    EXPECT_EQ(moving.time, 0);
    EXPECT_EQ(moving.time_cells, 4);
    EXPECT_EQ(moving.drift, (std::array<int, 3>{0, 0, 0}));
    const Noise given = noise_of("period = 1\ntime = -7\ntime_cells = 3\ndrift = [1, -2, 0]");
    EXPECT_EQ(given.time, -7);
    EXPECT_EQ(given.time_cells, 3);
    EXPECT_EQ(given.drift, (std::array<int, 3>{1, -2, 0}));
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

TEST(Frames, ThatAreNoWholeLoopsAreWarnedOf) {
    const auto outcome = parse(frames_recipe("frames = 10", "period = 4"));
    ASSERT_TRUE(outcome.value);
    ASSERT_EQ(outcome.diagnostics.size(), 1u);
    EXPECT_EQ(outcome.diagnostics[0].code, "W0219");
    EXPECT_EQ(outcome.value->parameters.bakes.size(), 10u);
    EXPECT_TRUE(parse(frames_recipe("frames = 8", "period = 4")).diagnostics.empty());
}

}  // namespace
}  // namespace skybake::config
