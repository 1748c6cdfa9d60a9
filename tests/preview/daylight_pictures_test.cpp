// Pictures of clouds beside what photographs of them show: white clouds before a blue sky.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "bakers/preview/cloud_inputs.h"
#include "bakers/render/cloud_view.h"
#include "config/presets/presets.h"
#include "config/recipe/init_text.h"
#include "tests/preview/skies.h"
#include "tests/support/outcomes.h"

namespace skybake {
namespace {

// Clear air, in which clouds are white before a blue sky. In the haze of the preset `earth`, a white sheet
// under a sun of 60 degrees is 4 % bluer than under that of the white, and clouds are as much yellower.
const test::Sky& earth() {
    static const test::Sky sky = test::sky_of("earth_clear_mountain");
    return sky;
}

// Fair-weather cumulus at a quarter of its preset's voxels along each edge. In air of coarser cells it rises
// higher, so its box is taller.
PreviewAssets cumulus() {
    const auto presets = config::cloud_presets();
    const auto humilis = std::ranges::find(presets, "cumulus_humilis", &config::Preset::name);
    return test::baked(config::cloud_init_text(*humilis),
                       {"bake.cumulus_humilis.size=[128, 128, 24]",
                        "clouds.cumulus_humilis.convection.cells=[48, 48, 12]",
                        R"(clouds.cumulus_humilis.extent=["4 km", "4 km", "0.96 km"])"});
}

// The input of small pictures under a sun of 35 degrees in Earth's sky, from below the clouds.
CloudPreviewInput input_of(const PreviewAssets& assets, PreviewOptions options) {
    options.sun_elevations_deg = {35};
    options.camera = {
        {{2000, 0, 150}}, options.camera ? options.camera->heading_degrees : 63, 12, 55};
    options.picture_size = {192, 108};
    CloudPreviewInput input = cloud_input(assets, assets.assets.front(), options);
    input.air = &earth().recipe;
    input.transmittance = &earth().transmittance;
    input.multiple_scattering = &earth().multiple_scattering;
    return input;
}

struct Pixel {
    double luma = 0;
    double red = 0;
    double blue = 0;
};

// The pixels from the darkest to the brightest.
std::vector<Pixel> sorted_pixels(const Picture& picture) {
    std::vector<Pixel> pixels;
    for (std::size_t i = 0; i + 2 < picture.rgb.size(); i += 3) {
        const std::uint8_t* rgb = picture.rgb.data() + i;
        pixels.push_back({0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2],
                          static_cast<double>(rgb[0]), static_cast<double>(rgb[2])});
    }
    std::ranges::sort(pixels, {}, &Pixel::luma);
    return pixels;
}

// Photographers put sunlit cumulus at 235 to 250 of 255. It is white, the sky is blue, and bases and ground
// are far darker than the tops.
TEST(DaylightPictures, ShowWhiteCumulusBeforeABlueSky) {
    const PreviewAssets assets = cumulus();
    const CloudPreviewInput input = input_of(assets, {});
    const std::vector<Pixel> pixels = sorted_pixels(cloud_pictures(input, 2).front().picture);
    const auto at = [&](double share) {
        return pixels[static_cast<std::size_t>(share * static_cast<double>(pixels.size() - 1))];
    };
    EXPECT_GT(at(0.99).luma, 240);
    EXPECT_LT(at(0.999).luma, 252);
    const auto white = std::ranges::lower_bound(pixels, 235.0, {}, &Pixel::luma);
    EXPECT_GT(pixels.end() - white, 0.03 * static_cast<double>(pixels.size()));
    std::vector<double> tints;
    for (auto pixel = white; pixel != pixels.end(); ++pixel) {
        tints.push_back(std::fabs(pixel->red - pixel->blue));
    }
    std::ranges::sort(tints);
    // White is the light of sun and sky on level ground; a cloud's lit side sees more sun and less sky, and far
    // clouds are seen through blue air. They may differ by a twentieth of white, but for one pixel in a hundred.
    EXPECT_LE(tints[tints.size() * 99 / 100], 0.05 * 255);
    EXPECT_LT(at(0.05).luma, 150);
    EXPECT_GT(std::ranges::count_if(pixels,
                                    [](const Pixel& pixel) { return pixel.blue - pixel.red > 70; }),
              0.05 * static_cast<double>(pixels.size()));
}

// The sun follows the camera, and stands against it in a second picture, unless somebody places it.
TEST(DaylightPictures, HaveTheSunBesideTheViewAndThenAgainstIt) {
    const PreviewAssets assets = cumulus();
    for (const double heading : {63.0, 200.0}) {
        PreviewOptions options;
        options.camera = CameraRequest{std::nullopt, heading, {}, {}};
        const CloudPreviewInput input = input_of(assets, options);
        ASSERT_EQ(input.suns.size(), 2U);
        EXPECT_EQ(input.suns[0].azimuth_degrees, heading + kSunBesideView);
        EXPECT_EQ(input.suns[1].azimuth_degrees, heading + kSunAgainstView);
        options.sun_azimuth_deg = 5;
        const CloudPreviewInput placed = input_of(assets, options);
        ASSERT_EQ(placed.suns.size(), 1U);
        EXPECT_EQ(placed.suns[0].azimuth_degrees, 5);
    }
    const auto pictures = cloud_pictures(input_of(assets, {}), 2);
    EXPECT_EQ(pictures[0].name, "cumulus_humilis_lit_sun_35");
    EXPECT_EQ(pictures[1].name, "cumulus_humilis_lit_sun_35_against");
    EXPECT_NE(pictures[0].caption.find("112 degrees to the left of the view"), std::string::npos);
    EXPECT_NE(pictures[1].title.find("against the light"), std::string::npos);
}

// A white sheet on the ground is neutral in the light of the white, warmer under a low sun, and bluer
// at dusk.
TEST(DaylightPictures, HaveTheLightOfThePlaceAsWhite) {
    const ScreenColor screen = daylight_screen({earth().medium, earth().tables}, 1);
    const auto sheet = [&](double elevation) {
        const GroundIrradiance light =
            ground_irradiance({earth().medium, earth().tables}, {elevation, 0}, 1);
        Image2<float> texel(1, 1, earth().medium.air.channels);
        for (std::size_t c = 0; c < texel.texels.size(); ++c) {
            texel.texels[c] = static_cast<float>(light.sun[c] + light.sky[c]);
        }
        const std::vector<float> shown = screen.shown(texel).texels;
        return std::array{shown[0] / shown[1], shown[2] / shown[1]};
    };
    EXPECT_NEAR(sheet(kDaylightElevation)[0], 1, 1e-4);
    EXPECT_NEAR(sheet(kDaylightElevation)[1], 1, 1e-4);
    EXPECT_NEAR(sheet(60)[0], 1, 0.03);
    EXPECT_NEAR(sheet(60)[1], 1, 0.03);
    EXPECT_GT(sheet(-4)[1], 1.2);
}

// From sunset, at -0.83 degrees, to the end of civil twilight the illuminance of level ground under a clear sky falls
// from 585 to 410 lux to 3.5 to 2 (American Meteorological Society, Glossary of Meteorology, "civil twilight").
TEST(DaylightPictures, KnowHowMuchLightEveningsHave) {
    const auto share = [](double elevation) {
        return daylight_shares({earth().medium, earth().tables}, {{elevation, 0}}, 1).front();
    };
    EXPECT_DOUBLE_EQ(share(kDaylightElevation), 1);
    const double fall = share(-0.83) / share(-6);
    EXPECT_GT(fall, 410 / 3.5);
    EXPECT_LT(fall, 585 / 2.0);
    for (double elevation = -18; elevation < 90; elevation += 6) {
        EXPECT_LT(share(elevation), share(elevation + 6)) << elevation;
    }
    const test::Sky vacuum = test::sky_of("vacuum");
    EXPECT_EQ(daylight_shares({vacuum.medium, vacuum.tables}, {{-5, 0}}, 1).front(), 0);
}

}  // namespace
}  // namespace skybake
