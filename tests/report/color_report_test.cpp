// Tests the costs of colours, and the ladder of errors from a recipe's tables to the sky that people see.
#include "bakers/report/color/color_report.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "bakers/light/sky_colors.h"
#include "bakers/report/truth/error_ladder.h"
#include "tests/report/cancelled_at.h"
#include "tests/support/atmospheres.h"

namespace skybake::test {
namespace {

const ColorErrorRow& row_of(const ColorReport& report, const std::string& family,
                            const std::string& variant) {
    return *std::find_if(report.rows.begin(), report.rows.end(), [&](const ColorErrorRow& row) {
        return row.family == family && row.variant == variant;
    });
}

// The bake of the same recipe states the same error.
TEST(ColorReport, RowOfTheRecipeHasTheErrorOfItsBake) {
    const config::Parameters parameters = recipe_of("preset = 'earth'\n").parameters;
    const auto report = measure_colors(parameters, true, {.threads = 2});
    ASSERT_TRUE(report);
    const auto baked = colors_of({parameters.wavelengths, *parameters.color, parameters.atmosphere},
                                 {.threads = 2});
    int own = 0;
    for (const ColorErrorRow& row : report->rows) {
        if (!row.of_recipe) continue;
        ++own;
        EXPECT_EQ(row.variant, "best 4");
        EXPECT_DOUBLE_EQ(row.error.median, baked->error.median);
        EXPECT_DOUBLE_EQ(row.error.disc[2], baked->error.disc[2]);
    }
    EXPECT_EQ(own, 1);
    // Factors of channels cannot mend the plain triple by much, and a matrix can.
    const auto plain = row_of(*report, "as R, G, B", "680, 550, 440 nm").error;
    EXPECT_GT(plain.disc[0], 0.1);
    EXPECT_GT(row_of(*report, "factors", "680, 550, 440 nm").error.ninth_decile,
              plain.ninth_decile / 4);
    EXPECT_LT(row_of(*report, "fitted matrix", "680, 550, 440 nm").error.median, plain.median / 2);
}

TEST(ColorReport, ListsOfTheRecipeAreCompared) {
    config::Parameters parameters =
        recipe_of("preset = 'earth'\n", {"wavelengths=['450 nm', '650 nm']", "color.space='xyz'"})
            .parameters;
    const auto report = measure_colors(parameters, true, {.threads = 2});
    ASSERT_TRUE(report);
    EXPECT_EQ(report->space, "xyz");
    EXPECT_TRUE(row_of(*report, "fitted matrix", "450, 650 nm").of_recipe);
}

TEST(ColorReport, EndsWhenItIsInterrupted) {
    const config::Parameters parameters = recipe_of("preset = 'earth'\n").parameters;
    for (const char* step : {"timing", "fitting colours"}) {
        testing::CancelledAt progress(step);
        EXPECT_FALSE(measure_colors(parameters, true, {.threads = 1, .progress = &progress}))
            << step;
    }
}

// --- The ladder ---------------------------------------------------------------------------------

const MethodErrors kMethods = {{"as_in_paper_32x32", {0.04, 0.2}},
                               {"mean_radiance_32x32", {0.03, 0.1}},
                               {"mean_radiance_64x32_twilight", {0.02, 0.08}},
                               {"moments_2", {0.01, 0.03}},
                               {"moments_8", {0.004, 0.02}}};

std::vector<LadderStep> ladder_of(const std::string& recipe,
                                  const std::vector<std::string>& settings = {}) {
    return error_ladder(recipe_of(recipe, settings).parameters, kMethods, {.threads = 2});
}

TEST(ErrorLadder, AirOfPapersIsAsFarOffAsPublished) {
    const std::vector<LadderStep> ladder = ladder_of("preset = 'earth_hillaire'\n");
    ASSERT_EQ(ladder.size(), 6u);
    // Bucholtz 1995 over the real column: 13.5, 12.0 and 9.2 % at 680, 550 and 440 nm. The preset's
    // column has the scale height of 8 km in an air that ends at 100 km.
    EXPECT_NEAR(ladder[1].size->high, 0.135, 0.005);
    EXPECT_NEAR(ladder[1].size->typical, (0.135 + 0.120 + 0.092) / 3, 0.005);
    // Three wavelengths as red, green and blue.
    EXPECT_GT(ladder[0].size->typical, 0.03);
    EXPECT_NE(ladder[0].sentence.find("Three wavelengths shown"), std::string::npos);
}

TEST(ErrorLadder, PolarisationIsThatOfThePublishedDepths) {
    const auto step =
        ladder_of("preset = 'earth'\n", {"wavelengths=['680 nm', '550 nm', '440 nm']"})[3];
    EXPECT_NEAR(step.size->high, 0.061, 0.001);
    EXPECT_NEAR(step.size->typical, (0.014 + 0.0255 + 0.044) / 3, 0.001);
    // A tenth of the air polarises a tenth of the light that is scattered again.
    const auto thin =
        ladder_of("preset = 'earth'\n", {"wavelengths=['680 nm', '550 nm', '440 nm']",
                                         "atmosphere.layers.air.pressure='10 hPa'"})[3];
    EXPECT_LT(thin.size->high, 0.0021);
    EXPECT_GT(thin.size->high, 0);
}

TEST(ErrorLadder, TakesClosureAndTableFromTheMethods) {
    const auto solved = ladder_of("preset = 'earth'\n[bake.multiple_scattering]\n");
    EXPECT_EQ(solved[4].size->typical, 0.004);
    ASSERT_TRUE(solved[5].size);
    EXPECT_EQ(solved[5].size->typical, 0.02);
    const auto paper =
        ladder_of("preset = 'earth'\n", {"bake.multiple_scattering.method='as_in_paper'",
                                         "bake.multiple_scattering.mapping='hillaire'"});
    EXPECT_EQ(paper[5].size->typical, 0.04);
    const auto none = ladder_of("preset = 'mars'\n");
    EXPECT_FALSE(none[1].size);
    EXPECT_FALSE(none[2].size);
}

// Own integrals over typed densities of the US Standard Atmosphere 1976, scattered once at 550 nm: an
// exponential of 8 km gives level ground 1.09, 1.28, 1.76 and 2.19 times as much light at 0, -2, -4
// and -6 degrees.
TEST(ErrorLadder, ProfilesAreAsFarOffAsTheirDensities) {
    const auto profile_of = [](const std::vector<std::string>& settings) {
        return ladder_of("preset = 'earth'\nwavelengths = ['550 nm']\n", settings)[2];
    };
    const LadderStep own = profile_of({});
    EXPECT_EQ(own.name, "profile");
    EXPECT_LT(own.size->high, 1e-9);
    const LadderStep exponential = profile_of({"atmosphere.layers.air.profile='exponential'",
                                               "atmosphere.layers.air.scale_height='8 km'"});
    EXPECT_NEAR(exponential.size->high, 1.19, 0.2);
    EXPECT_LT(exponential.size->typical, 0.28);
    EXPECT_GT(exponential.size->typical, 0.01);
}

}  // namespace
}  // namespace skybake::test
