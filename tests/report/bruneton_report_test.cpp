// The variants of Bruneton's tables.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <string_view>

#include "bakers/report/report.h"
#include "bakers/report/report_files.h"
#include "config/recipe/recipe.h"

namespace skybake {
namespace {

config::Recipe recipe_of(const std::string& table) {
    return *config::parse_recipe(
                "preset = \"earth_hillaire\"\n[bake.b]\nasset = \"bruneton\"\n" + table, "recipe")
                .value;
}

AssetReport report_of(const std::string& table) {
    const config::Recipe recipe = recipe_of(table);
    auto report = report_asset(recipe, recipe.parameters.bakes.at(0), {.quick = true});
    EXPECT_TRUE(report.value);
    return report.value.value_or(AssetReport{});
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

long count_if(const AssetReport& report, bool (*holds)(const ReportRow&)) {
    return std::count_if(report.rows.begin(), report.rows.end(), holds);
}

TEST(BrunetonReport, ScatteringSweepsMethodsSizesAndPixelTypes) {
    const AssetReport report =
        report_of("combined = true\nsize = [64, 16, 8]\nnu_size = 8\norders = 2\n");
    const ReportRow& fitted = row_of(report, "solved, fitted, half", "64x16x8");
    const ReportRow& exact = row_of(report, "solved, exact, float", "64x16x8");
    const ReportRow& coarse = row_of(report, "solved, exact, float", "32x8x4");
    row_of(report, "solved, fitted, float", "16x4x2");
    EXPECT_TRUE(fitted.of_recipe);
    EXPECT_EQ(count_if(report, [](const ReportRow& row) { return row.of_recipe; }), 1);
    // Texels are exact before they are moved; where there are fewer, lookups are worse.
    EXPECT_LT(exact.texel.rms, 2e-3);
    EXPECT_GT(fitted.texel.rms, 10 * exact.texel.rms);
    EXPECT_LT(exact.lookup.rms, coarse.lookup.rms);
    EXPECT_GT(fitted.time_ms, exact.time_ms);  // the one is a part of the other
    EXPECT_EQ(fitted.file_bytes, 64u * 16 * 8 * 4 * 2);
    // No more orders than asked for, so that nothing is as published.
    row_of(report, "iterated, float", "2 orders");
    EXPECT_EQ(count_if(report, [](const ReportRow& row) { return row.variant == "3 orders"; }), 0);
    EXPECT_EQ(count_if(report, [](const ReportRow& row) { return !row.baseline.empty(); }), 0);
    EXPECT_GE(count_if(report, [](const ReportRow& row) { return row.on_lookup_front; }), 1);
    EXPECT_GE(count_if(report, [](const ReportRow& row) { return row.on_texel_front; }), 1);
    EXPECT_EQ(report_figure(report).charts.at(1).title, "Texels: methods at 16x4x2");
}

TEST(BrunetonReport, FourIteratedOrdersAreTheBaseline) {
    const AssetReport report = report_of(
        "size = [16, 4, 2]\nnu_size = 8\nmethod = \"iterated\"\npixel_type = \"float\"\n"
        "table = \"higher_orders\"\norders = 4\n");
    const ReportRow& published = row_of(report, "iterated, float", "4 orders");
    EXPECT_EQ(published.baseline, "as published (Bruneton 2017)");
    EXPECT_TRUE(published.of_recipe);
    EXPECT_EQ(count_if(report, [](const ReportRow& row) { return row.of_recipe; }), 1);
    EXPECT_GT(published.texel.rms, 10 * row_of(report, "solved, exact, float", "16x4x2").texel.rms);
}

TEST(BrunetonReport, FlatTablesSweepSizesAndPixelTypes) {
    const AssetReport transmittance = report_of("table = \"transmittance\"\nsize = [32, 8, 1]\n");
    EXPECT_LT(row_of(transmittance, "quadrature, float", "32x8x1").texel.max, 1e-6);
    EXPECT_LT(row_of(transmittance, "quadrature, float", "64x16x1").lookup.rms,
              row_of(transmittance, "quadrature, float", "16x4x1").lookup.rms);
    EXPECT_EQ(count_if(transmittance, [](const ReportRow& row) { return row.of_recipe; }), 1);
    const AssetReport irradiance =
        report_of("table = \"irradiance\"\nsize = [4, 2, 1]\norders = 1\n");
    EXPECT_LT(row_of(irradiance, "quadrature, float", "4x2x1").texel.max, 5e-3);
    row_of(irradiance, "quadrature, half", "8x4x1");
}

// The user interrupts as soon as a step makes progress.
class InterruptedAt : public Progress {
  public:
    explicit InterruptedAt(std::string_view step) : step_(step) {}
    void advance(std::string_view step, double) override { cancelled_ |= step == step_; }
    bool cancelled() const override { return cancelled_; }

  private:
    std::string_view step_;
    bool cancelled_ = false;
};

TEST(BrunetonReport, AnInterruptionLeavesNeitherValueNorDiagnostics) {
    const config::Recipe recipe = recipe_of("size = [16, 4, 2]\nnu_size = 8\norders = 2\n");
    for (const std::string_view step : {"scattering", "density"}) {
        InterruptedAt progress(step);
        const auto report = report_asset(recipe, recipe.parameters.bakes.at(0),
                                         {.threads = 1, .quick = true, .progress = &progress});
        EXPECT_TRUE(progress.cancelled()) << step;
        EXPECT_FALSE(report.value) << step;
        EXPECT_TRUE(report.diagnostics.empty()) << step;
    }
}

}  // namespace
}  // namespace skybake
