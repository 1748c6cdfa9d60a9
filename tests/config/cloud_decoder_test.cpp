#include "config/sections/sections.h"

#include <gtest/gtest.h>

#include "tests/config/clouds.h"

namespace skybake::config {
namespace {

using testing::cloud_of;
using testing::cloud_recipe;

using Pair = std::array<double, 2>;
using Triple = std::array<int, 3>;

TEST(CloudDecoder, HasItsDefaults) {
    const Cloud cloud = cloud_of("");
    EXPECT_EQ(cloud.name, "c");
    EXPECT_EQ(cloud.noise, "n");
    EXPECT_EQ(cloud.noise_scale, (Triple{1, 1, 1}));
    EXPECT_EQ(cloud.detail, "");
    EXPECT_EQ(cloud.erosion, (Pair{0, 0})) << "nothing erodes";
    EXPECT_EQ(cloud.extent[0].meters, 1000);
    EXPECT_EQ(cloud.extent[1].meters, 2000);
    EXPECT_EQ(cloud.extent[2].meters, 500);
    EXPECT_EQ(cloud.base_altitude.meters, 0);
    EXPECT_EQ(cloud.height_profile.type, HeightProfileType::cumulus);
    EXPECT_EQ(cloud.coverage, 1);
    EXPECT_EQ(cloud.coverage_map.file, "");
    EXPECT_TRUE(cloud.coverage_map.path.empty());
    EXPECT_EQ(cloud.threshold, 0);
    EXPECT_EQ(cloud.edge_softness, 0.05);
    EXPECT_EQ(cloud.threshold_at, ThresholdAt::bake);
    EXPECT_EQ(cloud.channels, CloudChannels::density);
    EXPECT_EQ(cloud.extinction_scale.per_meter, 0.04);
    EXPECT_TRUE(cloud.towers.empty());
    const Cloud eroded = cloud_of("detail = 'd'");
    EXPECT_EQ(eroded.detail_scale, (Triple{1, 1, 1}));
    EXPECT_EQ(eroded.erosion, (Pair{0.2, 0.35}));
    EXPECT_EQ(eroded.wisp_height, 0.1);
}

TEST(CloudDecoder, DensityIsFullWhereTheFileHoldsIt) {
    EXPECT_FALSE(cloud_of("").full_at);
    EXPECT_EQ(cloud_of("full_at = 0.2").full_at, 0.2);
}

TEST(CloudDecoder, ReadsEveryKey) {
    const Cloud cloud = cloud_of(
        "noise_scale = [4, 5, 1]\ndetail = 'd'\ndetail_scale = 16\nerosion = [0, 0.95]\n"
        "wisp_height = 1\nbase_altitude = '-1.2 km'\ncoverage = '5 %'\nthreshold = 0.35\n"
        "edge_softness = 0\nthreshold_at = 'runtime'\nchannels = 'noise'\n"
        "extinction_scale = '0 /m'\n"
        "height_profile = { type = 'tabulated', table = [[0, 0.0], [0.25, 2]] }\n"
        "coverage_map = { file = 'maps/../a.png', channel = 'R', wrap = 'clamp', "
        "factor = 2, clamp = true, filter = 'nearest', color_space = 'srgb' }\n"
        "[[clouds.c.towers]]\ncenter = [0.2, -3]\nsigma = [0.03, 0.06]\nrotation = '180 deg'\n"
        "correlation = -0.5\namplitude = 0.4\n");
    Cloud expected;
    expected.name = "c";
    expected.noise = "n";
    expected.noise_scale = {4, 5, 1};
    expected.detail = "d";
    expected.detail_scale = {16, 16, 16};
    expected.erosion = {0, 0.95};
    expected.wisp_height = 1;
    expected.extent = {{{1000}, {2000}, {500}}};
    expected.base_altitude = {-1200};
    expected.height_profile = {HeightProfileType::tabulated, 50, 4, 1, {{0, 0}, {0.25, 2}}};
    expected.coverage = 0.05;
    expected.coverage_map = {"maps/../a.png",
                             "a.png",
                             "R",
                             MapWrap::clamp,
                             MapFilter::nearest,
                             MapColorSpace::srgb,
                             2,
                             true,
                             {},
                             {}};
    expected.threshold = 0.35;
    expected.threshold_at = ThresholdAt::runtime;
    expected.channels = CloudChannels::noise;
    Tower& tower = expected.towers.emplace_back();
    tower.name = "0";
    tower.center = {0.2, -3};
    tower.sigma = {0.03, 0.06};
    tower.rotation = {3.141592653589793};
    tower.correlation = -0.5;
    tower.amplitude = 0.4;
    EXPECT_TRUE(testing::without_places(cloud) == expected);
    const Cloud blended = cloud_of(
        "height_profile = { type = 'blended', cloud_type = 0.5 }\ntype_map = { file = 't.png' }\n");
    EXPECT_EQ(blended.height_profile.cloud_type, 0.5);
    EXPECT_EQ(blended.type_map.path, "t.png");
    EXPECT_EQ(blended.type_map.wrap, MapWrap::repeat);
    EXPECT_EQ(blended.type_map.filter, MapFilter::linear);
}

TEST(CloudDecoder, TowersHaveNames) {
    const Cloud cloud =
        cloud_of("[clouds.c.towers.big]\ncenter = [0, 0]\nsigma = [1, 1]\namplitude = 1\n");
    EXPECT_EQ(cloud.towers.at(0).name, "big");
}

TEST(CloudDecoder, WithoutADetailNothingErodes) {
    EXPECT_EQ(cloud_of("detail = 'd'\nerosion = [0.1, 0.2]", {"clouds.c.detail=\"\""}).erosion,
              (Pair{0, 0}))
        << "to take the detail away takes its keys away";
}

TEST(CloudDecoder, ScaledFrequenciesHaveARange) {
    const auto with_noise = [](const std::string& keys, const std::string& noise) {
        return "[clouds.c]\nnoise = 'n'\nextent = ['1 m', '1 m', '1 m']\n" + keys +
               "\n[noise.n.channels.Y]\ntype = 'worley'\n" + noise;
    };
    EXPECT_EQ(valid(with_noise("noise_scale = [1, 1, 1024]", "frequency = 1024"))
                  .parameters.clouds.size(),
              1u);
    // Only the first channel goes into a density, all of them into channels = "noise".
    const std::string more =
        "[noise.n.channels.R]\ntype = 'worley'\nfrequency = 4\n[noise.n.channels.G]\n"
        "type = 'worley'\nfrequency = 4096\n[noise.n.channels.B]\ntype = 'worley'\n"
        "[clouds.c]\nnoise = 'n'\nnoise_scale = 1000\nextent = ['1 m', '1 m', '1 m']\n";
    EXPECT_EQ(valid(more).parameters.clouds.size(), 1u);
}

// Maps are looked for as includes are: beside the file that names them.
TEST(CloudDecoder, MapsLieBesideTheirRecipe) {
    const testing::TemporaryFolder folder;
    folder.write("parts/map.toml", "clouds.c.coverage_map.file = '../maps/a.png'\n");
    folder.write("parts/type.toml", "clouds.c.type_map.file = 'b.png'\n");
    const auto file = folder.write(
        "main.toml", "include = ['parts/map.toml', 'parts/type.toml']\n" +
                         cloud_recipe("height_profile.type = 'blended'") +
                         "[bake.c]\nasset = 'cloud_volume'\ncloud = 'c'\nsize = [16, 16, 16]\n");
    const auto outcome =
        load_recipe(file, std::vector<std::string>{"clouds.c.type_map.file=c.png"});
    ASSERT_TRUE(outcome.value);
    const Cloud& cloud = outcome.value->parameters.clouds.at(0);
    EXPECT_EQ(cloud.coverage_map.path, folder.path() / "maps/a.png");
    EXPECT_EQ(cloud.coverage_map.file, "../maps/a.png");
    EXPECT_EQ(cloud.type_map.path, folder.path() / "c.png") << "settings: beside the recipe";
    const auto& inputs = outcome.value->inputs;
    ASSERT_EQ(inputs.size(), 5u);
    EXPECT_EQ(inputs[3], cloud.coverage_map.path);
    EXPECT_EQ(inputs[4], cloud.type_map.path);
}

}  // namespace
}  // namespace skybake::config
