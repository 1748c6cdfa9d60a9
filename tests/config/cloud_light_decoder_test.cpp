#include "config/assets/cloud_light.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "config/assets/cloud_volume.h"
#include "tests/config/clouds.h"

namespace skybake::config {
namespace {

using testing::cloud_recipe;
using testing::only_diagnostic;
using testing::valid;

constexpr double kDegree = 3.14159265358979323846 / 180;

// The light's keys begin on line 4; its volume, of 16x32x8 voxels, stands behind it.
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

Diagnostic fault(const std::string& keys) { return only_diagnostic(light_recipe(keys)); }

TEST(CloudLightDecoder, HasItsDefaults) {
    const CloudLightBake bake = light("sun_elevations = '30 deg'");
    EXPECT_EQ(bake.of, "v");
    EXPECT_EQ(bake.contents, CloudLightContents::optical_depth);
    EXPECT_EQ(bake.cell, 4);
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
    EXPECT_EQ(fault("sun_elevations = '30 deg'\nmax_error = '2 %'\ncell = 4").code, "E0109");
    const Diagnostic mips = fault("sun_elevations = '30 deg'\nmax_error = '2 %'\nmips = 'all'");
    EXPECT_EQ(mips.code, "E0110");
    EXPECT_EQ(mips.message, "`bake.l.mips` needs `cell`");
    EXPECT_EQ(fault("sun_elevations = '30 deg'\nmax_error = 0").code, "E0110");
    EXPECT_EQ(fault("contents = 'sky_visibility'\nmax_error = '2 %'\npixel_type = 'bc4'\n"
                    "formats = ['dds']")
                  .code,
              "E0131");
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
    for (const char* keys : {"degree = 0\npart = 2", "part = 2", "degree = 2\npart = 4"}) {
        EXPECT_EQ(fault(std::string("contents = 'sky_visibility'\n") + keys).code, "E0171") << keys;
    }
    EXPECT_EQ(fault("contents = 'sky_visibility'\ndegree = 2\npart = 4").label, "use at most 3");
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

TEST(CloudLightDecoder, RefusesRadianceThatNoFileHolds) {
    const std::string radiance = "contents = 'sun_radiance'\n";
    const Diagnostic several = fault(radiance + "sun_elevations = ['30 deg', '9 deg']");
    EXPECT_EQ(several.code, "E0176");
    EXPECT_EQ(fault(radiance + "sun_elevations = '9 deg'\nsun_azimuths = ['1 deg', '2 deg']").code,
              "E0171");
    EXPECT_EQ(fault(radiance + "sun_elevations = '9 deg'\npart = 2").code, "E0171");
    for (const char* key : {"droplet_diameter = '4 um'", "droplet_diameter = '51 um'",
                            "single_scattering_albedo = 0", "single_scattering_albedo = 1.1"}) {
        EXPECT_EQ(fault(radiance + "sun_elevations = '9 deg'\n" + key).code, "E0110") << key;
    }
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
    EXPECT_EQ(only_diagnostic(under("")).code, "E0105");
    EXPECT_EQ(only_diagnostic(under("sun_elevations = ['30 deg', '9 deg']")).code, "E0176");
    EXPECT_EQ(fault("contents = 'sky_radiance'\nsun_elevations = '30 deg'").code, "E0111");
}

TEST(CloudLightDecoder, RefusesASkyThatIsNotAboveTheCloud) {
    const std::string keys = "contents = 'clear_sky_radiance'\nsun_elevations = '30 deg'";
    const Diagnostic none = fault(keys);
    EXPECT_EQ(none.code, "E0189");
    EXPECT_EQ(none.where.line, 4);
    EXPECT_EQ(none.where.column, 12);
    // The cloud is 500 m high, and the air 100 km.
    const auto at = [&](const std::string& base) {
        return "preset = 'earth_hillaire'\n[bake.l]\nasset = 'cloud_light'\nof = 'v'\n" + keys +
               "\n[bake.v]\nasset = 'cloud_volume'\ncloud = 'c'\nsize = [16, 32, 8]\n" +
               cloud_recipe("base_altitude = '" + base + "'\n");
    };
    valid(at("99.4 km"));
    const Diagnostic high = only_diagnostic(at("99.5 km"));
    EXPECT_EQ(high.code, "E0189");
    EXPECT_EQ(high.label, "the air ends 100000 m above the ground");
}

TEST(CloudLightDecoder, TheKeyOneLetterAwayIsTheOneThatIsMeant) {
    EXPECT_EQ(fault("sun_elevation = ['30 deg']\nsun_elevations = ['30 deg']").label,
              "did you mean `sun_elevations`?");
}

TEST(CloudLightDecoder, DepthsBeyondHalvesAreFloats) {
    const auto type_of = [](const std::string& extinction, const std::string& keys) {
        const Recipe recipe = valid(
            "[bake.l]\nasset = 'cloud_light'\nof = 'v'\n" + keys +
            "\n[bake.v]\nasset = 'cloud_volume'\ncloud = 'c'\nsize = [16, 32, 8]\n" +
            cloud_recipe("extinction_scale = '" + extinction + "'\n"));
        return recipe.parameters.bakes.at(0).as<CloudLightBake>().pixel_type;
    };
    // The cloud is 500 m high: a vertical depth of 20, and of 5e5.
    EXPECT_EQ(type_of("40 /km", "sun_elevations = '1 deg'"), PixelType::half);
    EXPECT_EQ(type_of("1000 /m", "sun_elevations = '90 deg'"), PixelType::float32);
    EXPECT_EQ(type_of("1000 /m", "sun_elevations = '90 deg'\npixel_type = 'half'"), PixelType::half);
    EXPECT_EQ(type_of("1000 /m", "sun_elevations = '90 deg'\ncontents = 'transmittance'"), PixelType::half);
}

TEST(CloudLightDecoder, SunsStandAboveTheHorizon) {
    for (const char* sun : {"0 deg", "-5 deg", "0.9 deg", "91 deg"}) {
        const Diagnostic found =
            fault(fmt::format("sun_elevations = ['30 deg', '{}', '9 deg']", sun));
        EXPECT_EQ(found.code, "E0110") << sun;
        EXPECT_EQ(found.where.line, 4);
    }
}

TEST(CloudLightDecoder, SunsMakeOneThreeOrFourChannels) {
    EXPECT_EQ(fault("sun_elevations = ['30 deg', '20 deg']").code, "E0129");
    EXPECT_EQ(fault("sun_elevations = ['5 deg', '4 deg', '3 deg', '2 deg', '1 deg']").code,
              "E0129");
    EXPECT_EQ(fault("sun_elevations = '30 deg'\nsun_azimuths = ['0 deg', '1 deg']").code, "E0171");
    EXPECT_EQ(fault("").code, "E0105");
}

TEST(CloudLightDecoder, KeysApplyToTheirContents) {
    EXPECT_EQ(fault("contents = 'sky_visibility'\nsun_elevations = '30 deg'").code, "E0111");
    EXPECT_EQ(fault("sun_elevations = '30 deg'\ndegree = 2").code, "E0111");
}

TEST(CloudLightDecoder, NamesACloudVolume) {
    EXPECT_EQ(only_diagnostic("[bake.l]\nasset = 'cloud_light'\nof = 'w'\n"
                              "sun_elevations = '9 deg'\n" +
                              cloud_recipe(""))
                  .code,
              "E0133");
    EXPECT_EQ(fault("sun_elevations = '9 deg'\nchannel = 'G'").code, "E0134");
    EXPECT_EQ(fault("sun_elevations = '9 deg'\ncell = 0").code, "E0110");
}

}  // namespace
}  // namespace skybake::config
