// The sections of weather maps and of blue noise.
#include <gtest/gtest.h>

#include "config/assets/blue_noise.h"
#include "config/assets/weather_map.h"
#include "tests/config/noises.h"

namespace skybake::config {
namespace {

using testing::valid;

std::string map_recipe(const std::string& keys) {
    return "[noise.n]\nsize = [64, 32, 1]\n[noise.n.channels.R]\ntype = 'perlin'\n"
           "[noise.n.channels.G]\ntype = 'perlin'\n[noise.n.channels.B]\ntype = 'perlin'\n"
           "[bake.a]\nasset = 'weather_map'\nnoise = 'n'\n" +
           keys;
}
WeatherMapBake map_of(const std::string& keys) {
    const Recipe recipe = valid(map_recipe(keys));
    if (recipe.parameters.bakes.size() != 1) return {};
    return recipe.parameters.bakes[0].as<WeatherMapBake>();
}

using Shares = std::vector<double>;
using Names = std::vector<std::string>;

TEST(WeatherMapDecoder, HasDefaultsForEachChannel) {
    const WeatherMapBake bake = map_of("");
    EXPECT_EQ(bake.size, (std::array<int, 2>{64, 32})) << "the noise's";
    EXPECT_EQ(bake.content, WeatherContent::amounts);
    EXPECT_EQ(bake.covered, (Shares{0.5, 0.5, 0.5}));
    EXPECT_EQ(bake.full, (Shares{0, 0, 0}));
    EXPECT_EQ(bake.streaks, (Shares{0, 0, 0}));
    EXPECT_EQ(bake.edge, CoverEdge::linear);
    EXPECT_TRUE(bake.yields_to.empty());
    EXPECT_EQ(bake.formats, std::vector<FileFormat>{FileFormat::png});
    EXPECT_EQ(bake.pixel_type, PixelType::unorm8);
}

TEST(WeatherMapDecoder, ReadsEveryKey) {
    const WeatherMapBake bake = map_of(
        "size = [16, 24]\ncovered = ['30 %', 0.5, 1]\nfull = 0.1\nedge = 'smooth'\n"
        "yields_to = ['G', '', '']\nstreaks = [0, 0, 0.05]\nwind = '-90 deg'\n");
    EXPECT_EQ(bake.size, (std::array<int, 2>{16, 24}));
    EXPECT_EQ(bake.covered, (Shares{0.3, 0.5, 1}));
    EXPECT_EQ(bake.full, (Shares{0.1, 0.1, 0.1}));
    EXPECT_EQ(bake.edge, CoverEdge::smooth);
    EXPECT_EQ(bake.yields_to, (Names{"G", "", ""}));
    EXPECT_EQ(bake.streaks, (Shares{0, 0, 0.05}));
    EXPECT_NEAR(bake.wind.radians, -1.5707963, 1e-6);
}

TEST(WeatherMapDecoder, DirectionsNeedThreeChannels) {
    EXPECT_EQ(map_of("content = 'directions'\n").content, WeatherContent::directions);
}

BlueNoiseBake mask_of(const std::string& keys) {
    const Recipe recipe = valid("[bake.blue_noise]\n" + keys);
    if (recipe.parameters.bakes.size() != 1) return {};
    return recipe.parameters.bakes[0].as<BlueNoiseBake>();
}

TEST(BlueNoiseDecoder, HasTheDefaultsOfThePaper) {
    const BlueNoiseBake bake = mask_of("");
    EXPECT_EQ(bake.voxels(), (std::array<int, 3>{128, 128, 64}));
    EXPECT_EQ(bake.seed, 0U);
    EXPECT_EQ(bake.spatial_sigma, 1.9);
    EXPECT_EQ(bake.temporal_sigma, 1.9);
    EXPECT_EQ(bake.formats, std::vector<FileFormat>{FileFormat::bin});
    EXPECT_EQ(bake.pixel_type, PixelType::unorm8);
    EXPECT_EQ(mask_of("size = [32, 24]\nframes = 1\nseed = 7\n").voxels(),
              (std::array<int, 3>{32, 24, 1}));
}

TEST(BlueNoiseDecoder, OtherSizesAreForOtherTargets) {
    EXPECT_EQ(mask_of("target = 'takram'\n").voxels(), (std::array<int, 3>{128, 128, 64}));
    EXPECT_EQ(mask_of("frames = 32\ntarget = 'three'\n").frames, 32);
}

}  // namespace
}  // namespace skybake::config
