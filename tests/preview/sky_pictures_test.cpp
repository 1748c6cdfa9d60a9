#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <set>
#include <string>
#include <vector>

#include "bakers/preview/pictures/sky_pictures.h"
#include "bakers/preview/pictures/sky_reference.h"
#include "tests/io/files.h"
#include "tests/preview/skies.h"
#include "tests/support/number_rows.h"

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

// A picture of dusk is darker than one by day: its mean brightness falls with the sun.
TEST(SkyPictures, OfEveningsAreDarkerThanThoseOfDays) {
    SkyPreviewOptions options = small_options();
    options.sun_elevations_degrees = {30, 5, -4, -8};
    options.solved_pixels = 0;
    const std::vector<PreviewPicture> pictures = pictures_of(earth(), options);
    ASSERT_EQ(pictures.size(), 5U);
    const auto brightness = [&](std::size_t sun) {
        const std::vector<std::uint8_t>& bytes = pictures[1 + sun].picture.rgb;
        return std::accumulate(bytes.begin(), bytes.end(), 0.0) / static_cast<double>(bytes.size());
    };
    for (std::size_t sun = 0; sun < 3; ++sun) {
        EXPECT_GT(brightness(sun), brightness(sun + 1)) << sun;
    }
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

const BakeOptions kOptions{2, Certification::off, nullptr};

SkyLight solved(const config::Atmosphere& atmosphere) {
    return {atmosphere, config::SkyOrders::all, {}, kOptions};
}

// Tests a case in which the better sky looked worse, since the reference was the other one's closure.
TEST(SkyReference, SolvedTablesAreNearerToItThanHillairesAtEverySun) {
    const std::string text = testing::read_bytes(SKYBAKE_EXAMPLES "/sky.toml");
    test::Sky better;
    better.recipe = test::recipe_of(text, {"preset=\"earth_hillaire\""});
    test::bake_tables(better);
    const test::Sky worse = test::sky_of("earth_hillaire");
    const SkyLight light = solved(better.recipe.parameters.atmosphere);
    for (const double sun : {60.0, 10.0, 0.0, -4.0}) {
        const SkyView view = test::dome(20, 0.2, sun);
        const auto cost = [&](const test::Sky& sky) {
            return sky_cost(sky.medium, sky.tables, light, view, 2);
        };
        const SkyCost near = cost(better);
        const SkyCost far = cost(worse);
        EXPECT_LT(near.difference.error.rms, far.difference.error.rms) << sun;
        EXPECT_LT(near.difference.error.rms, 0.05) << sun;
        // Marching is a part of it, not most of it, and the same march for both.
        EXPECT_GT(near.marching.rms, 0) << sun;
        EXPECT_LT(near.marching.rms, 0.5 * near.difference.error.rms) << sun;
    }
    // The blue of the zenith is that of the solved sky.
    const SkyView day = test::dome(9, 0.2, 30);
    const auto red_over_blue = [&](const Image2<float>& radiance) {
        const Image2<float> shown = better.tables.screen.shown(radiance);
        return double{shown.texel(4, 4)[0]} / double{shown.texel(4, 4)[2]};
    };
    const double solved_ratio = red_over_blue(render_sky_reference(light, day, 2));
    EXPECT_NEAR(red_over_blue(render_sky(better.medium, better.tables, day, 2)) / solved_ratio, 1,
                0.05);
}

// The march that counts as exact: with half the steps it is the same within what its comment says.
TEST(SkyReference, ItsExactMarchIsConverged) {
    const test::Sky earth = test::sky_of("earth_hillaire");
    for (const double sun : {60.0, -4.0}) {
        const SkyView view = test::dome(16, 0.2, sun);
        const auto marched = [&](int steps) {
            return render_sky(earth.medium, earth.tables, view, 2, steps);
        };
        const Image2<float> exact = marched(kExactSteps);
        EXPECT_LT(sky_difference(marched(kExactSteps / 2), exact, view).error.rms, 2e-4) << sun;
    }
}

// Path-traced radiance of Earth's air over black ground, all orders with true phase functions, suns
// from the zenith to 6 degrees below the horizon: of another method and another author.
TEST(SkyReference, AgreesWithPathTracing) {
    const config::Atmosphere atmosphere =
        test::recipe_of("preset = \"earth_hillaire\"\n", {"atmosphere.ground_albedo=0"})
            .parameters.atmosphere;
    const SkyLight light = solved(atmosphere);
    std::vector<double> errors;
    for (const auto& v : test::number_rows(SKYBAKE_TEST_DATA "/truth_sky_setH0_h0.5.csv")) {
        // A dome of one pixel looks at the zenith: the view's zenith is what is asked of it.
        if (v[2] > 1e-9) continue;
        const SkyView view = test::dome(1, v[0], 90 - v[1]);
        const Image2<float> pixel = render_sky_reference(light, view, 1);
        errors.push_back(std::fabs(double{pixel.texel(0, 0)[static_cast<int>(v[4])]} / v[11] - 1));
    }
    ASSERT_GT(errors.size(), 10U);
    std::sort(errors.begin(), errors.end());
    EXPECT_LT(errors[errors.size() / 2], 0.005);
    EXPECT_LT(errors.back(), 0.03);
}

TEST(SkyReference, DoesNotDependOnThreads) {
    const SkyLight light =
        solved(test::recipe_of("preset = \"tiny_planet\"\n").parameters.atmosphere);
    const SkyView view = test::panorama(12, 0.2, 1);
    EXPECT_EQ(render_sky_reference(light, view, 1).texels,
              render_sky_reference(light, view, 3).texels);
}

}  // namespace

}  // namespace skybake
