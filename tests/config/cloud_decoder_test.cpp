#include "config/sections/sections.h"

#include <gtest/gtest.h>

#include "tests/config/clouds.h"

namespace skybake::config {
namespace {

using testing::cloud_of;
using testing::cloud_recipe;

using Pair = std::array<double, 2>;
using Triple = std::array<int, 3>;

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
