#include "bakers/preview/check_options.h"

#include <gtest/gtest.h>

#include <string>

#include "tests/support/outcomes.h"

namespace skybake {
namespace {

const LitPictures kBoth = {true, true, false};

config::Recipe recipe_with(const std::string& preview) {
    return test::without_diagnostics(config::parse_recipe(
        "[noise.n.channels.Y]\ntype = 'worley'\nfrequency = 2\noctaves = 1\n[clouds.c]\nnoise = "
        "'n'\n"
        "extent = ['2 km', '2 km', '1 km']\n[preview]\n" +
            preview,
        "test.toml"));
}

PreviewOptions complete(const PreviewOptions& given, const std::string& preview,
                        const LitPictures& lit = kBoth) {
    const config::Recipe recipe = recipe_with(preview);
    return test::without_diagnostics(completed(given, &recipe, lit));
}

constexpr const char* kAll =
    "size = [1920, 1080]\nsingle = true\naltitude = '2 km'\nsun_elevation = ['20 deg', '-4 deg']\n"
    "sun_azimuth = '150 deg'\nexposure = 2.5\ntone_curve = 'agx'\nglare = "
    "'camera'\n[preview.camera]\n"
    "position = ['2 km', '-3 km', '200 m']\nheading = '120 deg'\n";

TEST(CompleteOptions, TakeWhatTheRecipeSays) {
    const PreviewOptions options = complete({}, kAll);
    EXPECT_EQ(options.picture_size, (std::array{1920, 1080}));
    EXPECT_TRUE(options.single);
    EXPECT_EQ(options.altitude_m, 2000);
    ASSERT_EQ(options.sun_elevations_deg.size(), 2U);
    EXPECT_NEAR(options.sun_elevations_deg[0], 20, 1e-12);
    EXPECT_NEAR(options.sun_azimuth_deg.value(), 150, 1e-12);
    EXPECT_EQ(options.exposure_stops, 2.5);
    EXPECT_EQ(options.tone_curve, ToneCurve::agx);
    EXPECT_EQ(options.glare, Glare::camera);
    EXPECT_EQ(options.camera->position_m, (std::array<double, 3>{2000, -3000, 200}));
    EXPECT_NEAR(options.camera->heading_degrees.value(), 120, 1e-12);
    EXPECT_FALSE(options.camera->pitch_degrees);
}

// The camera of a cloud's preset stands within its tile, which is framed as a whole if it is shown alone.
TEST(CompleteOptions, ASingleTileIsFramed) {
    const auto position = [](const std::string& preview) {
        return test::without_diagnostics(
                   config::parse_recipe(
                       "[clouds.c]\npreset = 'cumulus_humilis'\n[preview]\n" + preview,
                       "test.toml"))
            .preview->camera.position;
    };
    EXPECT_TRUE(position(""));
    EXPECT_TRUE(position("single = false\n"));
    EXPECT_FALSE(position("single = true\n"));
    EXPECT_TRUE(position("single = true\ncamera.position = ['1 km', '2 km', '3 m']\n"));
}

TEST(CompleteOptions, OfTheCommandLineWin) {
    PreviewOptions given;
    given.picture_size = {64, 32};
    given.altitude_m = 5;
    given.sun_elevations_deg = {7};
    given.exposure_stops = 0;
    given.tone_curve = ToneCurve::aces;
    given.glare = Glare::eye;
    given.camera.emplace().heading_degrees = 10;
    const PreviewOptions options = complete(given, kAll);
    EXPECT_EQ(options.picture_size, given.picture_size);
    EXPECT_EQ(options.altitude_m, 5);
    EXPECT_EQ(options.sun_elevations_deg, given.sun_elevations_deg);
    EXPECT_NEAR(options.sun_azimuth_deg.value(), 150, 1e-12);  // only the elevation was given
    EXPECT_EQ(options.exposure_stops, 0);
    EXPECT_EQ(options.tone_curve, ToneCurve::aces);
    EXPECT_EQ(options.glare, Glare::eye);
    EXPECT_EQ(options.camera->heading_degrees, 10);
    EXPECT_EQ(options.camera->position_m, (std::array<double, 3>{2000, -3000, 200}));
}

// A tile that is asked for alone is framed anew, and a lower sun stands where the recipe's time has it.
TEST(CompleteOptions, OfTheCommandLineKeepWhatGoesWithThem) {
    PreviewOptions given;
    given.single = true;
    EXPECT_FALSE(complete(given, kAll).camera->position_m);
    const std::string timed = "at = '2026-06-21 18:30'\nlatitude = '47 deg'\nlongitude = '8 deg'\n";
    PreviewOptions lower;
    lower.sun_elevations_deg = {2};
    const PreviewOptions options = complete(lower, timed);
    EXPECT_EQ(options.sun_elevations_deg, lower.sun_elevations_deg);
    EXPECT_EQ(options.sun_azimuth_deg, complete({}, timed).sun_azimuth_deg);
    EXPECT_TRUE(options.sun_azimuth_deg);
}

// So a preview of some of a recipe's assets has no options that nothing uses.
TEST(CompleteOptions, AreThoseThatPicturesUse) {
    const PreviewOptions none = complete({}, kAll, {});
    EXPECT_FALSE(none.picture_size || none.altitude_m || none.camera || none.exposure_stops);
    const PreviewOptions sky = complete({}, kAll, {true, false, false});
    EXPECT_TRUE(sky.altitude_m && sky.glare && sky.exposure_stops);
    EXPECT_FALSE(sky.picture_size || sky.camera || sky.sun_azimuth_deg || sky.single);
    const PreviewOptions sweep = complete({}, kAll, {true, true, true});
    EXPECT_TRUE(sweep.camera && !sweep.picture_size);
}

constexpr const char* kZurich =
    "at = '2026-06-21 18:30 +02:00'\nlatitude = '47.4 deg'\nlongitude = '8.5 deg'\n";

// The sun stands in the west; +y is north, so that the azimuth from +x towards +y is
// 90 degrees less the compass's. The figures are PyEphem's.
TEST(CompleteOptions, PlaceTheSunAtATime) {
    const PreviewOptions options = complete({}, kZurich);
    ASSERT_EQ(options.sun_elevations_deg.size(), 1U);
    EXPECT_NEAR(options.sun_elevations_deg[0], 26.607, 0.015);
    EXPECT_NEAR(options.sun_azimuth_deg.value(), 90 - 276.456, 0.015);
    EXPECT_FALSE(options.at || options.place);
    EXPECT_NE(options.note.find("2026-06-21 16:30 UTC"), std::string::npos) << options.note;
    EXPECT_NE(options.note.find("47.4 degrees north, 8.5 degrees east"), std::string::npos);
    // The sky is the same all around.
    EXPECT_FALSE(complete({}, kZurich, {true, false, false}).sun_azimuth_deg);
}

TEST(CompleteOptions, LetATimeAndAnglesReplaceEachOther) {
    PreviewOptions angles;
    angles.sun_azimuth_deg = 10;
    const PreviewOptions by_angles = complete(angles, kZurich);
    EXPECT_TRUE(by_angles.sun_elevations_deg.empty());
    EXPECT_EQ(by_angles.sun_azimuth_deg, 10);
    EXPECT_TRUE(by_angles.note.empty());

    PreviewOptions time;
    time.at = config::parse_moment("2026-06-21 18:30 +02:00");
    time.place = {47.4, 8.5};
    EXPECT_EQ(complete(time, kAll).sun_elevations_deg, complete({}, kZurich).sun_elevations_deg);
    // The place of the recipe serves a time of the command line, and the other way round.
    time.place.reset();
    EXPECT_EQ(complete(time, kZurich).note, complete({}, kZurich).note);
    PreviewOptions place;
    place.place = {-47.4, 8.5};
    EXPECT_NE(complete(place, kZurich).note.find("47.4 degrees south"), std::string::npos);
}

TEST(CompleteOptions, ReportWhatIsMissing) {
    const auto fault = [](const PreviewOptions& options,
                          const config::Recipe* recipe) -> std::string {
        const auto outcome = completed(options, recipe, kBoth);
        EXPECT_FALSE(outcome.value);
        return outcome.diagnostics.empty() ? "" : outcome.diagnostics[0].message;
    };
    PreviewOptions options;
    options.at = config::Moment{};
    EXPECT_EQ(fault(options, nullptr), "--at needs a place");
    options.place = {1, 2};
    options.sun_azimuth_deg = 3;
    EXPECT_EQ(fault(options, nullptr), "--at excludes --sun-elevation and --sun-azimuth");
    options = {};
    options.place = {1, 2};
    EXPECT_EQ(fault(options, nullptr), "--place needs a time");
}

}  // namespace
}  // namespace skybake
