#include "config/assets/cloud_light.h"

#include <gtest/gtest.h>

#include <string>

#include "config/assets/cloud_volume.h"
#include "tests/config/clouds.h"

namespace skybake::config {
namespace {

using testing::cloud_recipe;

constexpr double kDegree = 3.14159265358979323846 / 180;

// A light with these keys, and its volume, of 16x32x8 voxels.
std::string light_recipe(const std::string& keys) {
    return "[bake.l]\nasset = 'cloud_light'\nof = 'v'\n" + keys +
           "\n[bake.v]\nasset = 'cloud_volume'\ncloud = 'c'\nsize = [16, 32, 8]\n" +
           cloud_recipe("");
}

CloudLightBake light(const std::string& keys) {
    const Recipe recipe = valid(light_recipe(keys));
    if (recipe.parameters.bakes.size() != 2) return {};
    return recipe.parameters.bakes[0].as<CloudLightBake>();
}

TEST(CloudLightDecoder, HasItsDefaults) {
    const CloudLightBake bake = light("sun_elevations = '30 deg'");
    EXPECT_EQ(bake.of, "v");
    EXPECT_EQ(bake.contents, CloudLightContents::optical_depth);
    EXPECT_EQ(bake.cell, 2);
    EXPECT_EQ(light("contents = 'sky_visibility'").cell, 4);
    EXPECT_EQ(light("contents = 'sun_radiance'\nsun_elevations = '30 deg'").cell, 4);
    ASSERT_EQ(bake.sun_elevations.size(), 1U);
    EXPECT_NEAR(bake.sun_elevations[0].radians, 30 * kDegree, 1e-12);
    EXPECT_TRUE(bake.sun_azimuths.empty());
    EXPECT_EQ(channels_of(bake), 1U);
}

TEST(CloudLightDecoder, ReadsEveryKey) {
    const CloudLightBake suns = light(
        "contents = 'shadow'\nsun_elevations = ['90 deg', '1 deg', '5 deg']\n"
        "sun_azimuths = ['0 deg', '-90 deg', '200 deg']\ncell = 3\nchannel = 'Y'");
    EXPECT_EQ(suns.contents, CloudLightContents::shadow);
    EXPECT_EQ(suns.cell, 3);
    EXPECT_EQ(suns.channel, "Y");
    EXPECT_EQ(channels_of(suns), 3U);
    EXPECT_NEAR(suns.sun_azimuths[1].radians, -90 * kDegree, 1e-12);
    const CloudLightBake sky = light("contents = 'sky_visibility'\ndegree = 2\npart = 3");
    EXPECT_EQ(sky.degree, 2);
    EXPECT_EQ(sky.part, 3);
}

TEST(CloudLightDecoder, ReadsMaxErrorInPlaceOfCell) {
    EXPECT_FALSE(light("sun_elevations = '30 deg'").max_error);
    EXPECT_EQ(light("sun_elevations = '30 deg'\nmax_error = '2 %'").max_error, 0.02);
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
    const CloudLightBake ground = light("contents = 'ground_radiance'");
    EXPECT_NEAR(ground.droplet_diameter.meters, 12e-6, 1e-15);
    EXPECT_EQ(ground.single_scattering_albedo, 1);
    EXPECT_TRUE(ground.sun_elevations.empty());
}

TEST(CloudLightDecoder, AClearSkyIsThatOfTheRecipe) {
    const std::string sky = "contents = 'clear_sky_radiance'\n";
    const std::string air = "preset = 'earth_hillaire'\n";
    const auto under = [&](const std::string& keys) { return air + light_recipe(sky + keys); };
    const Recipe recipe = valid(under("sun_elevations = '30 deg'\nsun_azimuths = '20 deg'\n"));
    ASSERT_EQ(recipe.parameters.bakes.size(), 2U);
    const auto& bake = recipe.parameters.bakes[0].as<CloudLightBake>();
    EXPECT_EQ(bake.contents, CloudLightContents::clear_sky_radiance);
    EXPECT_EQ(channels_of(bake), 4U);
}

TEST(CloudLightDecoder, DepthsBeyondHalvesAreFloats) {
    const auto type_of = [](const std::string& extinction, const std::string& keys) {
        const Recipe recipe =
            valid("[bake.l]\nasset = 'cloud_light'\nof = 'v'\n" + keys +
                  "\n[bake.v]\nasset = 'cloud_volume'\ncloud = 'c'\nsize = [16, 32, 8]\n" +
                  cloud_recipe("extinction_scale = '" + extinction + "'\n"));
        return recipe.parameters.bakes.at(0).as<CloudLightBake>().pixel_type;
    };
    // The cloud is 500 m high: a vertical depth of 20, and of 5e5.
    EXPECT_EQ(type_of("40 /km", "sun_elevations = '1 deg'"), PixelType::half);
    EXPECT_EQ(type_of("1000 /m", "sun_elevations = '90 deg'"), PixelType::float32);
    EXPECT_EQ(type_of("1000 /m", "sun_elevations = '90 deg'\npixel_type = 'half'"),
              PixelType::half);
    EXPECT_EQ(type_of("1000 /m", "sun_elevations = '90 deg'\ncontents = 'transmittance'"),
              PixelType::half);
}

}  // namespace
}  // namespace skybake::config
