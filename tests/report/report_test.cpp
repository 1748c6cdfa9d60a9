#include "bakers/report/report.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "bakers/report/measurement.h"
#include "config/recipe/recipe.h"
#include "tests/support/cancelled_at.h"
#include "tests/support/refused.h"

namespace skybake {
namespace {

// A recipe in memory that can be read with more settings.
struct TextRecipe {
    std::string text;

    config::Outcome<config::Recipe> operator()(std::span<const std::string> settings) const {
        return config::parse_recipe(text, "recipe", {}, settings);
    }
};

TextRecipe earth(const std::string& bake) { return {"preset = \"earth_hillaire\"\n" + bake}; }

config::Outcome<AssetReport> outcome_of(const TextRecipe& text, Progress* progress = nullptr) {
    const auto recipe = text({});
    EXPECT_TRUE(recipe.value) << text.text;
    return report_asset(text, *recipe.value, recipe.value->parameters.bakes.back(),
                        {.threads = 1, .quick = true, .progress = progress});
}

AssetReport report_of(const TextRecipe& text) {
    auto report = outcome_of(text);
    EXPECT_TRUE(report.value) << text.text;
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

void expect_sound(const AssetReport& report) {
    EXPECT_FALSE(report.reference.empty());
    EXPECT_FALSE(report.scale.empty());
    EXPECT_GT(report.lookup_points, 0);
    ASSERT_FALSE(report.rows.empty());
    EXPECT_TRUE(report.rows.front().of_recipe);
    EXPECT_EQ(std::count_if(report.rows.begin(), report.rows.end(),
                            [](const ReportRow& row) { return row.of_recipe; }),
              1);
    for (const ReportRow& row : report.rows) {
        EXPECT_GT(row.time_ms, 0) << row.variant;
        EXPECT_GT(row.write_ms, 0) << row.variant;
        EXPECT_GT(row.file_bytes, 0u) << row.variant;
        EXPECT_GE(row.texel.max, row.texel.rms) << row.variant;
        EXPECT_GE(row.lookup.max, row.lookup.rms) << row.variant;
    }
    for (const auto front : {&ReportRow::on_time_front, &ReportRow::on_bytes_front}) {
        EXPECT_TRUE(std::any_of(report.rows.begin(), report.rows.end(),
                                [&](const ReportRow& row) { return row.*front; }));
    }
}

TEST(Report, TransmittanceVariesItsKeys) {
    const AssetReport report = report_of(earth("[bake.transmittance]\nsize = [32, 8]\n"));
    expect_sound(report);
    const ReportRow& own = report.rows.front();
    EXPECT_LT(own.texel.max, 1e-7);
    EXPECT_LT(row_of(report, "size", "64x16").lookup.rms, own.lookup.rms);
    EXPECT_GT(row_of(report, "size", "16x4").lookup.rms, own.lookup.rms);
    const ReportRow& half = row_of(report, "pixel_type", "half");
    EXPECT_LT(half.file_bytes, own.file_bytes);
    EXPECT_GT(half.texel.rms, own.texel.rms);
    row_of(report, "mapping", "ue");
    row_of(report, "content", "optical_depth");
}

TEST(Report, HillairesMethodIsABaseline) {
    const AssetReport report =
        report_of(earth("[bake.multiple_scattering]\nmapping = \"hillaire\"\nsize = [8, 8]\n"));
    expect_sound(report);
    EXPECT_TRUE(report.sky.has_value());
    EXPECT_EQ(row_of(report, "method", "converged").baseline, "Hillaire 2020");
}

TEST(Report, VolumesVaryFormatsAndPixelTypes) {
    const AssetReport report = report_of(
        {"[noise.cells]\nseed = 5\nsize = [16, 16, 16]\nchannels.R = {type = \"worley\", frequency "
         "= 4}\n"
         "[bake.cells]\nasset = \"noise_volume\"\nnoise = \"cells\"\nformats = [\"bin\"]\n"
         "pixel_type = \"float\"\n"});
    expect_sound(report);
    EXPECT_EQ(report.rows.front().file_bytes, 4u * 16 * 16 * 16);
    EXPECT_EQ(row_of(report, "pixel_type", "half").file_bytes, 2u * 16 * 16 * 16);
    EXPECT_EQ(row_of(report, "pixel_type", "unorm8").file_bytes, 16u * 16 * 16);
    row_of(report, "formats", "vdb");
}

// A variant whose optical depths no half can hold is left out with a note.
TEST(Report, WhatCannotBeStoredIsLeftOutWithANote) {
    const AssetReport report =
        report_of(earth("[atmosphere.layers.rayleigh]\n"
                        "scattering = [\"1 /m\", \"1 /m\", \"1 /m\"]\n"
                        "[bake.t]\nasset = \"transmittance\"\n"
                        "size = [8, 4]\npixel_type = \"half\"\n"));
    ASSERT_EQ(report.notes.size(), 1u);
    EXPECT_TRUE(report.notes[0].starts_with("content optical_depth: "));
    row_of(report, "mapping", "ue");
}

TEST(Report, AnUnreachableMaxErrorIsDiagnosed) {
    test::expect_refused(
        outcome_of(earth("[bake.transmittance]\nmax_error = 1e-7\npixel_type = \"half\"\n")),
        "E0403");
}

TEST(Report, ErrorsAreTheSameOnEveryRun) {
    const TextRecipe text = earth("[bake.transmittance]\nsize = [8, 4]\n");
    const AssetReport first = report_of(text);
    const AssetReport second = report_of(text);
    ASSERT_EQ(first.rows.size(), second.rows.size());
    for (std::size_t i = 0; i < first.rows.size(); ++i) {
        EXPECT_EQ(first.rows[i].lookup.rms, second.rows[i].lookup.rms);
        EXPECT_EQ(first.rows[i].texel.max, second.rows[i].texel.max);
        EXPECT_EQ(first.rows[i].file_bytes, second.rows[i].file_bytes);
    }
}

TEST(Report, AnInterruptionLeavesNeitherValueNorDiagnostics) {
    for (const int times : {1, 40}) {
        testing::CancelledAt progress("texels", times);
        const auto report = outcome_of(earth("[bake.transmittance]\nsize = [32, 16]\n"), &progress);
        EXPECT_TRUE(progress.cancelled()) << times;
        EXPECT_FALSE(report.value) << times;
        EXPECT_TRUE(report.diagnostics.empty()) << times;
    }
}

// Each variant differs in one key, none is the recipe itself, and all of them can be read.
TEST(Variants, DifferInOneKey) {
    const TextRecipe text = earth(
        "[bake.my_sky]\nasset = \"sky_view\"\n"
        "sun_elevations = [\"30 deg\"]\nsize = [1, 8]\n");
    const auto recipe = text({});
    const auto variants = variants_of(*recipe.value, recipe.value->parameters.bakes.back());
    ASSERT_GT(variants.size(), 4u);
    EXPECT_TRUE(variants.front().settings.empty());
    for (std::size_t i = 1; i < variants.size(); ++i) {
        ASSERT_EQ(variants[i].settings.size(), 1u);
        EXPECT_TRUE(variants[i].settings[0].starts_with("bake.my_sky." + variants[i].family))
            << variants[i].settings[0];
    }
    EXPECT_EQ(variants[1].name, "1x4");
    EXPECT_EQ(variants[2].name, "1x16");
    EXPECT_TRUE(text(variants[2].settings).value);
    EXPECT_EQ(variants.back().baseline, "Ai et al. 2014");
}

}  // namespace
}  // namespace skybake
