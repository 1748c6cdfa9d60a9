#include "bakers/preview/pictures/sky_pictures.h"

#include <gtest/gtest.h>

#include <set>

#include "tests/preview/skies.h"

namespace skybake {
namespace {

using test::earth;

std::vector<PreviewPicture> pictures_of(const test::Sky& sky, const SkyPreviewOptions& options) {
    return sky_pictures(sky.recipe.parameters.atmosphere, sky.transmittance,
                        sky.multiple_scattering, options, 1);
}

SkyPreviewOptions small_options() {
    SkyPreviewOptions options;
    options.sun_elevations_degrees = {30, -0.5};
    options.dome_pixels = 64;
    options.solved_pixels = 12;
    options.panorama_pixels = 90;
    return options;
}

TEST(SkyPictures, AreADomeForEachSunAndPanoramas) {
    const std::vector<PreviewPicture> pictures = pictures_of(earth(), small_options());
    ASSERT_EQ(pictures.size(), 3U);
    EXPECT_EQ(pictures[0].name, "sky_panoramas");
    EXPECT_EQ(pictures[1].name, "sky_sun_30");
    EXPECT_EQ(pictures[2].name, "sky_sun_minus_0_5");
    for (const PreviewPicture& picture : pictures) {
        EXPECT_GT(picture.picture.width, 64);
        EXPECT_GT(
            std::set<std::uint8_t>(picture.picture.rgb.begin(), picture.picture.rgb.end()).size(),
            20U)
            << picture.name;
        EXPECT_NE(picture.caption.find("tone curve"), std::string::npos);
        EXPECT_NE(picture.caption.find("The camera is at 0.2 km"), std::string::npos);
    }
    EXPECT_EQ(pictures[2].title, "Sky, sun 0.5 degrees below the horizon");
    EXPECT_NE(pictures[1].caption.find("reference of every method, the solved sky"),
              std::string::npos);
    EXPECT_NE(pictures[1].caption.find("The error of marching in 40 steps alone"),
              std::string::npos);
    EXPECT_NE(pictures[1].caption.find(" stops), tone curve"), std::string::npos);
}

TEST(SkyPictures, WithoutTheSolvedSkyShowTheDomeAlone) {
    SkyPreviewOptions options = small_options();
    options.panorama_pixels = 0;
    const int with_solved = pictures_of(earth(), options).front().picture.width;
    options.solved_pixels = 0;
    const std::vector<PreviewPicture> pictures = pictures_of(earth(), options);
    ASSERT_EQ(pictures.size(), 2U);
    EXPECT_LT(2 * pictures.front().picture.width, with_solved);
    EXPECT_EQ(pictures.front().caption.find("RMS"), std::string::npos);
}

// Tables that fail everywhere do not stretch the scale until nothing is seen.
TEST(SkyPictures, EndTheDifferencesScaleAtAHundredPercent) {
    SkyPreviewOptions options = small_options();
    options.panorama_pixels = 0;
    EXPECT_EQ(pictures_of(earth(), options).front().caption.find("clipped at +-100 %"),
              std::string::npos);
    test::Sky wrong = test::sky_of("earth_hillaire");
    for (float& value : wrong.multiple_scattering.table.texels) value *= 1000;
    EXPECT_NE(pictures_of(wrong, options).front().caption.find("clipped at +-100 %"),
              std::string::npos);
}

// An exposure that is asked for is the one that is used.
TEST(SkyPictures, ObeyTheExposure) {
    SkyPreviewOptions options = small_options();
    options.solved_pixels = 0;
    options.panorama_pixels = 0;
    options.exposure_stops = 3;
    EXPECT_NE(pictures_of(earth(), options).front().caption.find("exposure 8 (+3.0 stops),"),
              std::string::npos);
    const auto sum = [&](double stops) {
        options.exposure_stops = stops;
        double total = 0;
        const std::vector<PreviewPicture> pictures = pictures_of(earth(), options);
        for (const std::uint8_t byte : pictures[1].picture.rgb) total += byte;
        return total;
    };
    EXPECT_LT(sum(3), sum(6));
}

TEST(SkyPictures, OfOtherAtmospheres) {
    SkyPreviewOptions options = small_options();
    options.camera_altitude_km = 1000;  // above any air: its top
    const test::Sky vacuum = test::sky_of("vacuum");
    EXPECT_EQ(pictures_of(vacuum, options).size(), 3U);
    const test::Sky grey =
        test::sky_of("vacuum", {"wavelengths=[\"550 nm\"]", "atmosphere.ground_albedo=0"});
    EXPECT_EQ(pictures_of(grey, small_options()).size(), 3U);
    // Tables of another number of channels than the atmosphere.
    EXPECT_TRUE(sky_pictures(grey.recipe.parameters.atmosphere, vacuum.transmittance,
                             vacuum.multiple_scattering, options, 1)
                    .empty());
}

}  // namespace
}  // namespace skybake
