#include "bakers/report/report.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <string_view>

#include "config/recipe/recipe.h"
#include "tests/report/cancelled_at.h"

namespace skybake {
namespace {

config::Recipe recipe_of(const std::string& bakes) {
    auto recipe = config::parse_recipe("preset = \"earth_hillaire\"\n" + bakes, "recipe");
    EXPECT_TRUE(recipe.value);
    return recipe.value.value_or(config::Recipe{});
}

AssetReport report_of(const std::string& bake) {
    const config::Recipe recipe = recipe_of(bake);
    auto report = report_asset(recipe, recipe.parameters.bakes.at(0), {.quick = true});
    EXPECT_TRUE(report.value);
    return report.value.value_or(AssetReport{});
}

long count_if(const AssetReport& report, bool (*holds)(const ReportRow&)) {
    return std::count_if(report.rows.begin(), report.rows.end(), holds);
}

const ReportRow& row_of(const AssetReport& report, const std::string& family,
                        const std::string& variant) {
    const auto found = std::find_if(
        report.rows.begin(), report.rows.end(),
        [&](const ReportRow& row) { return row.family == family && row.variant == variant; });
    static const ReportRow none;
    EXPECT_NE(found, report.rows.end()) << family << ", " << variant;
    return found == report.rows.end() ? none : *found;
}

void expect_sound(const AssetReport& report) {
    EXPECT_FALSE(report.reference.empty());
    EXPECT_FALSE(report.scale.empty());
    EXPECT_GE(report.repetitions, 3);
    EXPECT_GT(report.lookup_points, 0);
    EXPECT_FALSE(report.volume);
    for (const ReportRow& row : report.rows) {
        EXPECT_EQ(row.size.size(), 2u) << row.variant;
        EXPECT_FALSE(row.volume_file) << row.variant;
        EXPECT_GT(row.time_ms, 0) << row.variant;
        EXPECT_GT(row.file_bytes, 0u) << row.variant;
        EXPECT_GE(row.texel.max, row.texel.rms) << row.variant;
        EXPECT_GE(row.lookup.max, row.lookup.rms) << row.variant;
    }
    EXPECT_EQ(count_if(report, [](const ReportRow& row) { return row.of_recipe; }), 1);
    EXPECT_GE(count_if(report, [](const ReportRow& row) { return row.on_lookup_front; }), 1);
    EXPECT_GE(count_if(report, [](const ReportRow& row) { return row.on_texel_front; }), 1);
    EXPECT_EQ(count_if(report,
                       [](const ReportRow& row) {
                           return row.on_texel_front && !row.in_quadrature_sweep;
                       }),
              0);
}

TEST(Report, TransmittanceSweepsItsKnobs) {
    const AssetReport report = report_of("[bake.transmittance]\nsize = [32, 8]\n");
    expect_sound(report);
    EXPECT_EQ(count_if(report, [](const ReportRow& row) { return !row.baseline.empty(); }), 4);
    const ReportRow& exact = row_of(report, "exact", "32x8");
    const ReportRow& end_points = row_of(report, "end-point rule", "40 steps");
    EXPECT_TRUE(exact.of_recipe);
    EXPECT_LT(exact.texel.max, 1e-7);
    EXPECT_GT(end_points.texel.rms, 5e-3);
    const ReportRow& half = row_of(report, "exact, half", "32x8");
    EXPECT_EQ(half.time_ms, exact.time_ms);
    EXPECT_LT(half.file_bytes, exact.file_bytes);
    EXPECT_GT(half.texel.rms, exact.texel.rms);
    EXPECT_LT(row_of(report, "exact", "64x16").lookup.rms, exact.lookup.rms);
    row_of(report, "exact, optical depth", "32x8");
    row_of(report, "exact, ue mapping", "32x8");
    row_of(report, "midpoint rule", "40 steps");
    row_of(report, "trapezoid rule", "500 steps");
}

const std::string kClosure =
    "[bake.multiple_scattering]\nmethod = \"converged\"\nmapping = \"hillaire\"\n";

// The variants are Hillaire's closure; the sky's error is that of the recipe's own table.
TEST(Report, ASolvedTableIsNoneOfItsVariants) {
    const std::string size = "size = [16, 16]\n";
    const AssetReport solved = report_of("[bake.multiple_scattering]\n" + size);
    EXPECT_EQ(count_if(solved, [](const ReportRow& row) { return row.of_recipe; }), 0);
    ASSERT_EQ(solved.notes.size(), 1u);
    EXPECT_NE(solved.notes[0].find("is solved"), std::string::npos);
    EXPECT_GT(solved.rows.size(), 9u);
    const AssetReport closure = report_of(kClosure + size);
    ASSERT_TRUE(solved.sky && closure.sky);
    EXPECT_LT(solved.sky->median, 0.7 * closure.sky->median);
}

TEST(Report, MultipleScatteringSweepsItsKnobs) {
    const AssetReport report = report_of(kClosure + "size = [8, 8]\n");
    expect_sound(report);
    const ReportRow& paper = row_of(report, "as in the paper", "8x8");
    EXPECT_FALSE(paper.baseline.empty());
    const ReportRow& coarse = row_of(report, "quadrature levels, hillaire", "level 1");
    const ReportRow& fine = row_of(report, "quadrature levels, hillaire", "level 6");
    EXPECT_GT(coarse.time_ms, 0);  // how long is for benchmarks
    EXPECT_GT(coarse.texel.rms, fine.texel.rms);
    EXPECT_LT(coarse.texel.rms, paper.texel.rms);
    row_of(report, "sizes, hillaire, half", "8x8");
    row_of(report, "sizes, twilight", "16x16");
}

TEST(Report, TheRecipesOwnVariantIsMarkedWhateverItIs) {
    for (const char* bake :
         {"[bake.t]\nasset = \"transmittance\"\nsize = [16, 8]\nmapping = \"ue\"\n",
          "[bake.t]\nasset = \"transmittance\"\nsize = [16, 8]\ncontent = \"optical_depth\"\n"
          "pixel_type = \"half\"\n",
          "[bake.t]\nasset = \"transmittance\"\nsize = [1, 1]\n",
          "[bake.t]\nasset = \"transmittance\"\nmax_error = \"20 %\"\n",
          "[bake.m]\nasset = \"multiple_scattering\"\nsize = [4, 4]\nmethod = \"as_in_paper\"\n",
          "[bake.m]\nasset = \"multiple_scattering\"\nsize = [4, 4]\npixel_type = \"half\"\n"
          "method = \"converged\"\nmapping = \"twilight\"\n"}) {
        const AssetReport report = report_of(bake);
        EXPECT_EQ(count_if(report, [](const ReportRow& row) { return row.of_recipe; }), 1) << bake;
    }
}

TEST(Report, ErrorsAreTheSameOnEveryRun) {
    const std::string bake = "[bake.transmittance]\nsize = [8, 4]\n";
    const AssetReport first = report_of(bake);
    const AssetReport second = report_of(bake);
    ASSERT_EQ(first.rows.size(), second.rows.size());
    for (std::size_t i = 0; i < first.rows.size(); ++i) {
        EXPECT_EQ(first.rows[i].lookup.rms, second.rows[i].lookup.rms);
        EXPECT_EQ(first.rows[i].texel.max, second.rows[i].texel.max);
        EXPECT_EQ(first.rows[i].file_bytes, second.rows[i].file_bytes);
    }
}

// Optical depths that no half can hold leave the others in place.
TEST(Report, WhatCannotBeStoredIsLeftOutWithANote) {
    const AssetReport report = report_of(
        "[atmosphere.layers.rayleigh]\n"
        "scattering = [\"1 /m\", \"1 /m\", \"1 /m\"]\n"
        "[bake.transmittance]\nsize = [8, 4]\n");
    EXPECT_FALSE(report.notes.empty());
    EXPECT_EQ(
        count_if(report,
                 [](const ReportRow& row) { return row.family == "exact, optical depth, half"; }),
        0);
    EXPECT_GT(count_if(report, [](const ReportRow& row) { return row.family == "exact"; }), 0);
}

TEST(Report, AnAccuracyThatIsNotReachedIsANoteToo) {
    const AssetReport report = report_of(kClosure + "size = [16, 8]\nmax_texel_error = 1e-5\n");
    ASSERT_EQ(report.notes.size(), 1u);
    EXPECT_EQ(count_if(report, [](const ReportRow& row) { return row.of_recipe; }), 0);
    EXPECT_GT(report.rows.size(), 9u);
}

TEST(Report, AnUnreachableMaxErrorIsDiagnosed) {
    const config::Recipe recipe =
        recipe_of("[bake.transmittance]\nmax_error = 1e-7\npixel_type = \"half\"\n");
    const auto report = report_asset(recipe, recipe.parameters.bakes.at(0), {.quick = true});
    EXPECT_FALSE(report.value);
    ASSERT_FALSE(report.diagnostics.empty());
    EXPECT_EQ(report.diagnostics[0].code, "E0403");
}

TEST(Report, AnInterruptionLeavesNeitherValueNorDiagnostics) {
    const config::Recipe recipe = recipe_of("[bake.transmittance]\nsize = [8, 4]\n");
    for (const std::string_view step : {"timing", "reference"}) {
        testing::CancelledAt progress(step);
        const auto report = report_asset(recipe, recipe.parameters.bakes.at(0),
                                         {.threads = 1, .quick = true, .progress = &progress});
        EXPECT_TRUE(progress.cancelled()) << step;
        EXPECT_FALSE(report.value) << step;
        EXPECT_TRUE(report.diagnostics.empty()) << step;
    }
}

}  // namespace
}  // namespace skybake
