#include <gtest/gtest.h>

#include <array>
#include <string>
#include <vector>

#include "config/assets/environment.h"
#include "config/sections/cloud.h"
#include "tests/config/recipes.h"

namespace skybake::config {
namespace {

using testing::valid;
using testing::value_at;
using Codes = std::vector<std::string>;
using Size = std::array<int, 2>;

const std::string around =
    "preset = 'earth_hillaire'\n[bake.environment]\nsun_elevation = '20 deg'\n";
const std::string cloud =
    "\n[noise.n.channels.Y]\ntype = 'perlin'\n[clouds.c]\nnoise = 'n'\n"
    "extent = ['1 km', '1 km', '1 km']\n"
    "[bake.v]\nasset = 'cloud_volume'\ncloud = 'c'\nsize = [16, 16, 16]\n";

EnvironmentBake environment_of(const std::string& text) {
    return valid(text).parameters.bakes.front().as<EnvironmentBake>();
}

TEST(EnvironmentDecoder, SizesFollowTheMapping) {
    EXPECT_EQ(environment_of(around).size, (Size{1024, 512}));
    EXPECT_EQ(environment_of(around + "mapping = 'cube'").size, (Size{256, 1536}));
    EXPECT_EQ(environment_of(around + "mapping = 'octahedral'").size, (Size{512, 512}));
    EXPECT_EQ(value_at(valid(around + "mapping = 'cube'"), "bake.environment.size").origin,
              "derived");
    EXPECT_EQ(environment_of(around + "mapping = 'cube'\nsize = [7, 42]").size, (Size{7, 42}));
}

TEST(EnvironmentDecoder, LevelsHalveWholeSquares) {
    EXPECT_EQ(environment_of(around + "mips = 'all'").mips, 11);
    const std::string cube = around + "mapping = 'cube'\nsize = [32, 192]\nmips = ";
    EXPECT_EQ(environment_of(cube + "4").mips, 4);
}

// Renderers load longitude and latitude, some engines cubes too, and Bevy nothing but cubes.
TEST(EnvironmentDecoder, TargetsLoadTheirMappings) {
    const EnvironmentBake three = environment_of(around + "target = 'three'");
    EXPECT_EQ(three.mapping, EnvironmentMapping::longitude_latitude);
    EXPECT_EQ(three.formats, std::vector{FileFormat::exr});
    const EnvironmentBake cube = environment_of(around + "target = 'three'\nmapping = 'cube'");
    EXPECT_EQ(cube.formats, std::vector{FileFormat::ktx2});
    EXPECT_EQ(cube.pixel_type, PixelType::half);
    const EnvironmentBake bevy = environment_of(around + "target = 'bevy'");
    EXPECT_EQ(bevy.mapping, EnvironmentMapping::cube);
    EXPECT_EQ(bevy.size, (Size{256, 1536}));
}

TEST(EnvironmentDecoder, CloudsAreAVolumeOfTheRecipe) {
    const EnvironmentBake bake =
        environment_of(around + "clouds = 'v'\ncamera_x = '2 km'\nsamples = 3" + cloud);
    EXPECT_TRUE(bake.has_clouds());
    EXPECT_EQ(bake.camera_x.meters, 2000);
    EXPECT_EQ(bake.samples, 3);
}

TEST(EnvironmentDecoder, CloudsAreAListOfLayers) {
    const std::string second =
        "\n[bake.high]\nasset = 'cloud_volume'\ncloud = 'c'\nsize = [16, 16, 16]";
    const auto names_of = [&](const std::string& clouds) {
        return environment_of(around + "clouds = " + clouds + cloud + second).clouds;
    };
    EXPECT_EQ(names_of("'v'"), Codes{"v"});
    EXPECT_EQ(names_of("['v', 'high']"), (Codes{"v", "high"}));
    EXPECT_EQ(names_of("['high', 'v']"), (Codes{"high", "v"}));
    EXPECT_FALSE(environment_of(around).has_clouds());
}

}  // namespace
}  // namespace skybake::config
