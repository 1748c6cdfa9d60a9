#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <numbers>
#include <string>
#include <vector>

#include "config/assets/asset_kind.h"
#include "config/assets/cloud_distance.h"
#include "config/assets/cloud_light.h"
#include "config/assets/cloud_volume.h"
#include "config/assets/noise_volume.h"
#include "config/assets/occupancy.h"
#include "tests/config/clouds.h"
#include "tests/config/noises.h"

namespace skybake::config {
namespace {

using testing::cloud_recipe;

// The recipe's one asset of a kind, and the recipe that it must be.
template <class Asset>
Asset only(const std::string& text) {
    const Recipe recipe = valid(text);
    const auto found = std::ranges::find_if(recipe.parameters.bakes,
                                            [](const Bake& bake) { return bake.find<Asset>(); });
    if (found == recipe.parameters.bakes.end()) return {};
    return found->template as<Asset>();
}

TEST(NoiseVolumeDecoder, ReadsEveryKey) {
    const auto bake = only<NoiseVolumeBake>(testing::volume_recipe(
        "size = [64, 32, 16]\nformats = ['vdb', 'exr']\npixel_type = 'float'\nlayout = 'atlas'\n"
        "columns = 4\nmips = 3\ncompression = 'piz'\nvdb_compression = 'none'",
        "type = 'worley'\nfrequency = 1"));
    EXPECT_EQ(testing::to_string(bake), "n [64, 32, 16] 0 1 4 3 3 0 1 0");
}

// A bake with these keys, and its cloud.
std::string volume_recipe(const std::string& bake) {
    return "[bake.c]\nasset = 'cloud_volume'\ncloud = 'c'\n" + bake + "\n" + cloud_recipe("");
}

TEST(CloudVolumeDecoder, ReadsEveryKey) {
    const auto bake = only<CloudVolumeBake>(
        volume_recipe("size = [32, 64, 16]\nformats = ['vdb', 'exr']\npixel_type = 'float'\n"
                      "layout = 'atlas'\ncolumns = 4\nmips = 'all'\ncompression = 'piz'\n"
                      "vdb_compression = 'none'"));
    EXPECT_EQ(testing::to_string(bake), "c [32, 64, 16] 0 1 4 7 3 0 1 0");
}

// 0.1 is no double, and 500 / 0.1 and the like are whole numbers but for rounding.
TEST(CloudVolumeDecoder, RoundingIsNoPartOfAVoxel) {
    for (int i = 1; i <= 100; ++i) {
        const double edge = i / 10.0;  // nearest to i tenths
        for (int count = 1; count <= 1000; ++count) {
            const double extent = i * count / 10.0;
            const WholeVoxels voxels = whole_voxels({extent}, {edge});
            ASSERT_EQ(voxels.count, count) << edge;
            ASSERT_FALSE(voxels.longer) << edge;
            const WholeVoxels more = whole_voxels({extent * (1 + 1e-12)}, {edge});
            ASSERT_EQ(more.count, count + 1) << edge;
            ASSERT_TRUE(more.longer) << edge;
        }
    }
    EXPECT_EQ(whole_voxels({1e-3}, {1e8}).count, 1);
}

// So they are in files: by size and extent, which make the same volume again.
TEST(CloudVolumeDecoder, TheLongerExtentIsRecorded) {
    const Recipe once = testing::valid_with_warnings(volume_recipe("voxel_size = '30 m'"));
    const std::string carried = testing::all_parameters(once);
    EXPECT_NE(carried.find("extent = [\"1020 m\", \"2010 m\", \"510 m\"]"), std::string::npos);
    EXPECT_EQ(carried.find("voxel_size"), std::string::npos);
    const Recipe twice = valid(carried);
    EXPECT_EQ(testing::all_parameters(twice), carried);
    EXPECT_EQ(twice.parameters.bakes.at(0).as<CloudVolumeBake>().extent,
              (std::array<Length, 3>{{{1020}, {2010}, {510}}}));
}

// An asset `o` with these keys, and the volume that it is made from.
std::string made_from(const std::string& keys, const std::string& volume = "") {
    return "[bake.o]\nof = 'v'\n" + keys + "\n[bake.v]\nasset = 'cloud_volume'\ncloud = 'c'\n" +
           "size = [16, 32, 8]\n" + volume + cloud_recipe("");
}

TEST(CloudDistanceDecoder, ReadsEveryKey) {
    const auto bake = only<CloudDistanceBake>(
        made_from("asset = 'cloud_distance'\nchannel = 'Y'\ncell = 8\nrange = ['0 m', '2 "
                  "km']\ncore = '0.3 km'\n"
                  "contents = ['distance', 'density_scale', 'detail_type', 'profile']\n"
                  "pixel_type = 'half'\nformats = ['exr']\nmips = 1",
                  "formats = ['bin']\n"));
    EXPECT_EQ(bake.channel, "Y");
    EXPECT_EQ(bake.cell, 8);
    EXPECT_EQ(bake.range, (std::array<Length, 2>{{{0}, {2000}}}));
    EXPECT_EQ(bake.core.meters, 300);
    EXPECT_EQ(bake.contents, (std::vector<DistanceContent>{
                                 DistanceContent::distance, DistanceContent::density_scale,
                                 DistanceContent::detail_type, DistanceContent::profile}));
    EXPECT_EQ(bake.pixel_type, PixelType::half);
}

TEST(OccupancyDecoder, ReadsEveryKey) {
    EXPECT_EQ(
        testing::to_string(only<OccupancyBake>(made_from(
            "asset = 'occupancy'\nchannel = 'Y'\ncell = 8\nfilter = 'tricubic'\nrule = 'thesis'\n"
            "contents = ['leap', 'occupied', 'maximum']\nformats = ['bin', 'vdb']\n"
            "pixel_type = 'float'\nlayout = 'atlas'\ncolumns = 1\nmips = 3\n"
            "compression = 'none'\nvdb_compression = 'zip'"))),
        "v Y 8 2 1 1 0 3 0 1 1 3 0 1 2 1");
}

// The parameters that a file carries are a recipe, whose bake can be checked, of any volume: one of
// bytes is no VDB file, which a volume is by default.
TEST(OccupancyDecoder, FilesCarryARecipe) {
    for (const char* files : {"", "pixel_type = 'unorm8'\nformats = ['bin']\n",
                              "pixel_type = 'unorm16'\nformats = ['png']\nmips = 2\n",
                              "pixel_type = 'float'\nformats = ['exr']\n"}) {
        for (const char* keys : {"asset = 'occupancy'", "asset = 'cloud_distance'\ncell = 2"}) {
            const Recipe recipe = valid(made_from(keys, files));
            const Bake& bake = recipe.parameters.bakes.at(0);
            std::vector<Read> reads = kind_of(bake).reads(recipe.parameters, bake);
            reads.push_back({"bake.o", Roles::all()});
            const std::string carried = parameters_toml(recipe, reads);
            EXPECT_EQ(parameters_toml(valid(carried), reads), carried);
        }
    }
}

CloudLightBake light(const std::string& keys) {
    return only<CloudLightBake>(made_from("asset = 'cloud_light'\n" + keys));
}

TEST(CloudLightDecoder, ReadsEveryKey) {
    const CloudLightBake suns = light(
        "contents = 'shadow'\nsun_elevations = ['90 deg', '1 deg', '5 deg']\n"
        "sun_azimuths = ['0 deg', '-90 deg', '200 deg']\ncell = 3\nchannel = 'Y'");
    EXPECT_EQ(suns.contents, CloudLightContents::shadow);
    EXPECT_EQ(suns.cell, 3);
    EXPECT_EQ(suns.channel, "Y");
    EXPECT_EQ(channels_of(suns), 3U);
    EXPECT_NEAR(suns.sun_azimuths[1].radians, -std::numbers::pi / 2, 1e-12);
    const CloudLightBake sky = light("contents = 'sky_visibility'\ndegree = 2\npart = 3");
    EXPECT_EQ(sky.degree, 2);
    EXPECT_EQ(sky.part, 3);
}

TEST(CloudLightDecoder, PartsHoldFourCoefficients) {
    const auto channels = [](int degree, int part) {
        return channels_of(light(fmt::format(
            "contents = 'transmittance_harmonics'\ndegree = {}\npart = {}", degree, part)));
    };
    EXPECT_EQ(channels(0, 1), 1U);
    EXPECT_EQ(channels(1, 1), 4U);
    EXPECT_EQ(channels(2, 2), 4U);
    EXPECT_EQ(channels(2, 3), 1U);
    EXPECT_EQ(channels(3, 4), 4U);
}

TEST(CloudLightDecoder, RadianceIsThatOfOneSource) {
    const CloudLightBake sun = light(
        "contents = 'sun_radiance'\nsun_elevations = '30 deg'\nsun_azimuths = '10 deg'\n"
        "degree = 3\npart = 4\ndroplet_diameter = '20 um'\nsingle_scattering_albedo = 0.9");
    EXPECT_EQ(sun.contents, CloudLightContents::sun_radiance);
    EXPECT_EQ(channels_of(sun), 4U);
    EXPECT_NEAR(sun.droplet_diameter.meters, 20e-6, 1e-15);
    EXPECT_EQ(sun.single_scattering_albedo, 0.9);
}

TEST(CloudLightDecoder, AClearSkyIsThatOfTheRecipe) {
    const auto bake =
        only<CloudLightBake>("preset = 'earth_hillaire'\n" +
                             made_from("asset = 'cloud_light'\ncontents = 'clear_sky_radiance'\n"
                                       "sun_elevations = '30 deg'\nsun_azimuths = '20 deg'\n"));
    EXPECT_EQ(bake.contents, CloudLightContents::clear_sky_radiance);
    EXPECT_EQ(channels_of(bake), 4U);
}

}  // namespace
}  // namespace skybake::config
