#include <gtest/gtest.h>

#include <array>
#include <string>
#include <vector>

#include "config/assets/blue_noise.h"
#include "config/assets/bruneton.h"
#include "config/assets/environment.h"
#include "config/assets/optical_depth.h"
#include "config/assets/weather_map.h"
#include "config/sections/cloud.h"
#include "tests/config/noises.h"
#include "tests/config/recipes.h"

namespace skybake::config {
namespace {

using Codes = std::vector<std::string>;
using Size = std::array<int, 2>;
using Size3 = std::array<int, 3>;

const std::string bruneton = "preset = 'earth_hillaire'\n[bake.bruneton]\n";
const std::string columns = "preset = 'earth_hillaire'\n[bake.optical_depth]\n";

template <class Asset>
Asset only(const std::string& text) {
    const Recipe recipe = valid(text);
    if (recipe.parameters.bakes.size() != 1) return {};
    return recipe.parameters.bakes[0].as<Asset>();
}

TEST(PrecomputedDecoder, DefaultsFollowTheTable) {
    const auto scattering = only<BrunetonBake>(bruneton);
    EXPECT_EQ(scattering.size, (Size3{256, 128, 32}));
    EXPECT_EQ(scattering.nu_size, 8);
    EXPECT_EQ(scattering.orders, 0);
    EXPECT_FALSE(scattering.combined);
    EXPECT_EQ(scattering.mie_layers, Codes{"mie"});
    EXPECT_EQ(scattering.solar_irradiance, (std::vector<double>{1, 1, 1}));
    EXPECT_NEAR(scattering.sun_cos_zenith_min, -0.2079, 1e-4);
    EXPECT_EQ(only<BrunetonBake>(bruneton + "table = 'transmittance'").size, (Size3{256, 64, 1}));
    EXPECT_EQ(only<BrunetonBake>(bruneton + "table = 'irradiance'").size, (Size3{64, 16, 1}));
    EXPECT_EQ(value_at(valid(bruneton), "bake.bruneton.size").origin, "derived");
}

TEST(PrecomputedDecoder, TakramsDefaultsAreItsOwn) {
    const auto takram = only<BrunetonBake>(bruneton + "convention = 'takram'");
    EXPECT_EQ(takram.sun_cos_zenith_min, -0.5);
    EXPECT_TRUE(takram.combined);
    EXPECT_EQ(takram.solar_irradiance, (std::vector<double>{1.474, 1.8504, 1.91198}));
}

TEST(PrecomputedDecoder, OrdersAreThoseGiven) {
    EXPECT_EQ(only<BrunetonBake>(bruneton + "orders = 4").orders, 4);
}

TEST(PrecomputedDecoder, ColumnsAreOfLayers) {
    EXPECT_EQ(only<OpticalDepthBake>(columns).kinds, (Codes{"mie", "ozone", "rayleigh"}));
    EXPECT_EQ(only<OpticalDepthBake>(columns + "kinds = ['mie']").kinds, Codes{"mie"});
    EXPECT_EQ(only<OpticalDepthBake>(columns + "sampling = 'uniform'\nshells = 8").shells, 8);
}

TEST(PrecomputedDecoder, TheirParametersAreARecipe) {
    for (const std::string& text : {bruneton, columns, bruneton + "table = 'irradiance'"}) {
        const std::string parameters = testing::all_parameters(valid(text));
        EXPECT_EQ(testing::all_parameters(valid(parameters)), parameters);
    }
}

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

// The sections of weather maps and of blue noise.

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
