#include <gtest/gtest.h>

#include <array>
#include <string>
#include <vector>

#include "config/assets/environment.h"
#include "tests/config/recipes.h"

namespace skybake::config {
namespace {

using testing::codes_and_places;
using testing::parse;
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

Codes faults(const std::string& text) { return codes_and_places(parse(text).diagnostics); }

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
    EXPECT_EQ(faults(around + "mapping = 'cube'\nsize = [8, 8]"), Codes{"E0142 5:8"});
    EXPECT_EQ(faults(around + "mapping = 'octahedral'\nsize = [8, 4]"), Codes{"E0142 5:8"});
    EXPECT_EQ(faults(around + "size = [8, 8]"), Codes{});
}

TEST(EnvironmentDecoder, LevelsHalveWholeSquares) {
    EXPECT_EQ(environment_of(around + "mips = 'all'").mips, 11);
    const std::string cube = around + "mapping = 'cube'\nsize = [32, 192]\nmips = ";
    EXPECT_EQ(environment_of(cube + "4").mips, 4);
    EXPECT_EQ(faults(cube + "5"), Codes{"E0172 6:8"});
    EXPECT_EQ(faults(cube + "'all'"), Codes{"E0172 6:8"});
    EXPECT_EQ(faults(around + "mapping = 'octahedral'\nsize = [9, 9]\nmips = 2"),
              Codes{"E0172 6:8"});
    EXPECT_EQ(faults(around + "level_content = 'ggx'"), Codes{"E0172 4:17"});
    EXPECT_EQ(faults(around + "level_content = 'ggx'\nmips = 6"), Codes{});
}

// Renderers load longitude and latitude, some engines cubes too, and Bevy nothing but cubes.
TEST(EnvironmentDecoder, TargetsLoadTheirMappings) {
    EXPECT_EQ(faults(around + "target = 'blender'"), Codes{});
    EXPECT_EQ(faults(around + "target = 'blender'\nmapping = 'cube'"), Codes{"E0160 5:11"});
    const EnvironmentBake three = environment_of(around + "target = 'three'");
    EXPECT_EQ(three.mapping, EnvironmentMapping::longitude_latitude);
    EXPECT_EQ(three.formats, std::vector{FileFormat::exr});
    const EnvironmentBake cube = environment_of(around + "target = 'three'\nmapping = 'cube'");
    EXPECT_EQ(cube.formats, std::vector{FileFormat::ktx2});
    EXPECT_EQ(cube.pixel_type, PixelType::half);
    const EnvironmentBake bevy = environment_of(around + "target = 'bevy'");
    EXPECT_EQ(bevy.mapping, EnvironmentMapping::cube);
    EXPECT_EQ(bevy.size, (Size{256, 1536}));
    const auto refused = parse(around + "target = 'three'\nmapping = 'octahedral'").diagnostics;
    ASSERT_EQ(codes_and_places(refused), Codes{"E0160 5:11"});
    EXPECT_EQ(refused[0].label, "it loads longitude_latitude and cube");
}

TEST(EnvironmentDecoder, TargetsOfCubesRefuseOtherMappings) {
    EXPECT_EQ(faults(around + "target = 'bevy'\nmapping = 'longitude_latitude'"),
              Codes{"E0160 5:11"});
}

// A sequence is baked as one asset for each frame: an environment shows one of them.
TEST(EnvironmentDecoder, CloudsAreOneFrameOfASequence) {
    const std::string moving =
        "[noise.n]\nperiod = 12\n[noise.n.channels.Y]\ntype = 'perlin'\nfrequency = 2\n"
        "[clouds.c]\nnoise = 'n'\nextent = ['8 km', '8 km', '4 km']\n"
        "[bake.v]\nasset = 'cloud_volume'\ncloud = 'c'\nsize = [16, 16, 8]\nframes = 12\n";
    const auto refused = parse(around + "clouds = 'v'\n" + moving).diagnostics;
    ASSERT_EQ(codes_and_places(refused), Codes{"E0133 4:10"});
    EXPECT_EQ(refused[0].message,
              "`bake.environment.clouds` must name one frame of [bake.v], which has several");
    EXPECT_EQ(refused[0].label, "this recipe has v_0001 to v_0012");
    EXPECT_EQ(faults(around + "clouds = 'v_0003'\n" + moving), Codes{});
}

TEST(EnvironmentDecoder, CloudsAreAVolumeOfTheRecipe) {
    const EnvironmentBake bake =
        environment_of(around + "clouds = 'v'\ncamera_x = '2 km'\nsamples = 3" + cloud);
    EXPECT_TRUE(bake.has_clouds());
    EXPECT_EQ(bake.camera_x.meters, 2000);
    EXPECT_EQ(bake.samples, 3);
    EXPECT_EQ(faults(around + "clouds = 'w'" + cloud), Codes{"E0133 4:10"});
    EXPECT_EQ(faults(around + "clouds = 'environment'" + cloud), Codes{"E0133 4:10"});
    EXPECT_EQ(faults(around + "camera_x = '2 km'"), Codes{"E0111 4:1"});
    EXPECT_EQ(faults(around + "samples = 3"), Codes{"E0111 4:1"});
    EXPECT_EQ(faults(around + "clouds = 'v'\naltitude = '200 km'" + cloud), Codes{"E0172 4:10"});
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
    EXPECT_EQ(faults(around + "clouds = ['v', 'w']" + cloud), Codes{"E0133 4:10"});
    EXPECT_EQ(faults(around + "clouds = ['v', 'v']" + cloud), Codes{"E0172 4:10"});
    EXPECT_FALSE(environment_of(around).has_clouds());
}

}  // namespace
}  // namespace skybake::config
