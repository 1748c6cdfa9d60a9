#include "bakers/field/baked.h"
#include "bakers/report/volume_report.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "bakers/assets/registry/registry.h"
#include "bakers/io/manifest/asset_files.h"
#include "tests/config/recipes.h"
#include "tests/report/cancelled_at.h"

namespace skybake {
namespace {

using config::FileFormat;
using config::PixelType;

// Values are those of fbm over [0, 1]; cells of 16 to 4 voxels.
const char* const kNoise =
    "[noise.n]\nseed = 3\n"
    "channels.R = {type = 'perlin', frequency = 2, octaves = 3, gain = 0.5}\n"
    "channels.G = {type = 'worley', frequency = 2, octaves = 2, gain = 0.5}\n"
    "channels.B = {type = 'constant', value = 0.25}\n";
const char* const kBake =
    "[bake.v]\nasset = 'noise_volume'\nnoise = 'n'\nsize = [32, 32, 16]\n"
    "formats = ['exr', 'vdb', 'bin']\n";

config::Recipe recipe_of(const std::string& text) {
    auto recipe = config::parse_recipe(text, "recipe");
    EXPECT_TRUE(recipe.value) << text;
    return recipe.value.value_or(config::Recipe{});
}

AssetReport report_of(const std::string& text, int threads = 0) {
    const config::Recipe recipe = recipe_of(text);
    auto report =
        report_asset(recipe, recipe.parameters.bakes.at(0), {.threads = threads, .quick = true});
    EXPECT_TRUE(report.value) << text;
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

// Returns the report that all tests look at and no one changes.
const AssetReport& sample() {
    static const AssetReport report = report_of(std::string(kNoise) + kBake);
    return report;
}

TEST(NoiseVolumeReport, IsSound) {
    const AssetReport& report = sample();
    EXPECT_EQ(report.kind, "noise_volume");
    EXPECT_FALSE(report.reference.empty());
    EXPECT_FALSE(report.scale.empty());
    EXPECT_TRUE(report.notes.empty());
    for (const ReportRow& row : report.rows) {
        EXPECT_EQ(row.asset, "v");
        EXPECT_EQ(row.size.size(), 3u) << row.variant;
        EXPECT_GT(row.time_ms, 0) << row.variant;
        EXPECT_GT(row.file_bytes, 0u) << row.variant;
        EXPECT_GE(row.texel.max, row.texel.rms) << row.variant;
        EXPECT_GE(row.lookup.max, row.lookup.rms) << row.variant;
        ASSERT_TRUE(row.volume_file) << row.variant;
        EXPECT_GT(row.volume_file->write_ms, 0) << row.variant;
        EXPECT_TRUE(row.in_quadrature_sweep || !row.on_texel_front) << row.variant;
    }
}

TEST(NoiseVolumeReport, HasARowForEachKnob) {
    const AssetReport& report = sample();
    for (const char* compression : {"none", "zip", "zips", "piz"}) {
        const ReportRow& row = row_of(report, "exr, half", std::string("exr ") + compression);
        EXPECT_EQ(row.volume_file->compression, compression);
        EXPECT_EQ(row.volume_file->format, FileFormat::exr);
    }
    for (const char* compression : {"none", "zip", "blosc"}) {
        const ReportRow& row = row_of(report, "vdb, half", std::string("vdb ") + compression);
        EXPECT_EQ(row.volume_file->compression, compression);
        EXPECT_EQ(row.volume_file->format, FileFormat::vdb);
    }
    for (const char* type : {"float", "half", "unorm16", "unorm8"}) {
        for (const char* size : {"16x16x8", "24x24x12", "32x32x16", "48x48x24", "64x64x32"}) {
            row_of(report, std::string("bin, ") + type, size);
        }
    }
    row_of(report, "octaves cut short, bin, float", "1 of 3 octaves");
    row_of(report, "octaves cut short, bin, float", "2 of 3 octaves");
    EXPECT_FALSE(row_of(report, "point by point, bin, float", "32x32x16").baseline.empty());
    for (const char* blocks : {"dds, bc6h", "nvdb, fp16", "nvdb, fp8"}) {
        row_of(report, blocks, "32x32x16");
    }
    EXPECT_EQ(report.rows.size(), 4u + 3u + 4u * 5u + 2u + 1u + 3u);
}

TEST(NoiseVolumeReport, MarksEachFileOfTheRecipe) {
    std::vector<std::string> own;
    for (const ReportRow& row : sample().rows) {
        if (row.of_recipe) own.push_back(row.family + ": " + row.variant);
    }
    EXPECT_EQ(own, (std::vector<std::string>{"exr, half: exr zip", "vdb, half: vdb blosc",
                                             "bin, half: 32x32x16"}));
}

TEST(NoiseVolumeReport, ErrorsFallWithSize) {
    for (const char* family : {"bin, float", "bin, unorm16"}) {
        double last = 1;
        for (const char* size : {"16x16x8", "24x24x12", "32x32x16", "48x48x24", "64x64x32"}) {
            const ReportRow& row = row_of(sample(), family, size);
            EXPECT_LT(row.lookup.rms, 0.9 * last) << family << ", " << size;
            last = row.lookup.rms;
        }
    }
}

// Half a step of a unorm, half a unit of a half below 1, on a scale that is a share of [0, 1].
TEST(NoiseVolumeReport, ErrorsFallWithPrecision) {
    const auto texel = [](const char* type) {
        return row_of(sample(), std::string("bin, ") + type, "32x32x16").texel;
    };
    EXPECT_LT(texel("float").max, 2e-6);
    EXPECT_GT(texel("unorm16").rms, 10 * texel("float").rms);
    EXPECT_GT(texel("half").rms, 2 * texel("unorm16").rms);
    EXPECT_GT(texel("unorm8").rms, 4 * texel("half").rms);
    double smallest_range = 1;
    for (const ValueStatistics& channel : sample().volume->statistics) {
        const double range = channel.max - channel.min;
        if (range > 0) smallest_range = std::min(smallest_range, range);
    }
    EXPECT_LT(texel("unorm8").max, 0.5 / 255 / smallest_range * 1.001);
}

// Against all octaves, whatever the size and the type can hold.
TEST(NoiseVolumeReport, ErrorsFallWithOctaves) {
    const std::string family = "octaves cut short, bin, float";
    const ReportRow& one = row_of(sample(), family, "1 of 3 octaves");
    const ReportRow& two = row_of(sample(), family, "2 of 3 octaves");
    const ReportRow& three = row_of(sample(), "bin, float", "32x32x16");
    EXPECT_GT(one.texel.rms, 1.5 * two.texel.rms);
    EXPECT_GT(two.texel.rms, 1000 * three.texel.rms);
    EXPECT_GT(one.lookup.rms, two.lookup.rms);
    EXPECT_TRUE(three.in_quadrature_sweep && one.in_quadrature_sweep);
}

TEST(NoiseVolumeReport, BaselineIsSlowerAndTheSame) {
    const ReportRow& baseline = row_of(sample(), "point by point, bin, float", "32x32x16");
    const ReportRow& own = row_of(sample(), "bin, float", "32x32x16");
    EXPECT_GT(baseline.time_ms, own.time_ms);
    EXPECT_EQ(baseline.texel.max, own.texel.max);
    EXPECT_EQ(baseline.lookup.rms, own.lookup.rms);
    EXPECT_FALSE(baseline.on_texel_front);
}

// A lookup cannot tell the finer types apart: of equal sizes the smallest file is on the front.
TEST(NoiseVolumeReport, BytesFrontHasNoFileThatIsLargerForNothing) {
    const auto on_front = [](const char* type) {
        return row_of(sample(), std::string("bin, ") + type, "16x16x8").volume_file->on_bytes_front;
    };
    EXPECT_TRUE(on_front("unorm8"));
    EXPECT_FALSE(on_front("unorm16"));
    EXPECT_FALSE(on_front("half"));
    EXPECT_FALSE(on_front("float"));
}

// The report's figures are those of the bake: nothing is estimated.
TEST(NoiseVolumeReport, FiguresOfTheRecipeAreThoseThatBakeFinds) {
    const config::Recipe recipe = recipe_of(std::string(kNoise) + kBake);
    const auto baked = bake_asset(recipe, recipe.parameters.bakes.at(0), {.threads = 1});
    ASSERT_TRUE(baked.value);
    const Baked& volume = *baked.value;
    ManifestAsset asset = describe_with_files(volume);
    const config::testing::TemporaryFolder folder;
    AtomicFiles files;
    ASSERT_TRUE(stage_files(volume, asset, folder.path(), files, 1).value);

    std::vector<const ReportRow*> own;
    for (const ReportRow& row : sample().rows) {
        if (row.of_recipe) own.push_back(&row);
    }
    ASSERT_EQ(own.size(), asset.files.size());
    for (std::size_t i = 0; i < own.size(); ++i) {
        EXPECT_EQ(own[i]->file_bytes, asset.files[i].bytes) << own[i]->variant;
        EXPECT_EQ(own[i]->volume_file->compression, asset.files[i].compression);
        EXPECT_EQ(own[i]->texel.max, volume.certificate.texel.max);
        EXPECT_EQ(own[i]->texel.rms, volume.certificate.texel.rms);
        EXPECT_EQ(own[i]->lookup.max, volume.certificate.lookup.max);
        EXPECT_EQ(own[i]->lookup.rms, volume.certificate.lookup.rms);
    }
    ASSERT_TRUE(sample().volume);
    EXPECT_EQ(sample().volume->seam_error, 0);
    ASSERT_EQ(sample().volume->channels, (std::vector<std::string>{"R", "G", "B"}));
    for (std::size_t c = 0; c < 3; ++c) {
        const ValueStatistics& statistics = sample().volume->statistics[c];
        EXPECT_EQ(statistics.min, volume.levels[0].statistics[c].min);
        EXPECT_EQ(statistics.max, volume.levels[0].statistics[c].max);
        EXPECT_EQ(statistics.mean, volume.levels[0].statistics[c].mean);
    }
    EXPECT_EQ(sample().volume->statistics[2].mean, 0.25);
}

// Where voxels sample their corners, texture coordinates mean other places in each size.
TEST(NoiseVolumeReport, KnowsWhereVoxelsAre) {
    for (const char* sampling : {"corners", "slices_at_corners"}) {
        const AssetReport report =
            report_of(std::string("[noise.n]\nsampling = '") + sampling +
                      "'\nchannels.Y = {type = 'worley', frequency = 2, octaves = 1}\n"
                      "[bake.v]\nasset = 'noise_volume'\nnoise = 'n'\nsize = [12, 10, 9]\n");
        for (const ReportRow& row : report.rows) {
            if (row.pixel_type == PixelType::float32) {
                EXPECT_LT(row.texel.max, 2e-6) << row.variant;
            }
        }
    }
}

TEST(NoiseVolumeReport, PureFiguresDoNotDependOnThreads) {
    const AssetReport one = report_of(std::string(kNoise) + kBake, 1);
    const AssetReport two = report_of(std::string(kNoise) + kBake, 2);
    ASSERT_EQ(one.rows.size(), two.rows.size());
    for (std::size_t i = 0; i < one.rows.size(); ++i) {
        const ReportRow& a = one.rows[i];
        const ReportRow& b = two.rows[i];
        EXPECT_EQ(a.family + a.variant, b.family + b.variant);
        EXPECT_EQ(a.file_bytes, b.file_bytes) << a.variant;
        EXPECT_EQ(a.texel.max, b.texel.max) << a.variant;
        EXPECT_EQ(a.texel.rms, b.texel.rms) << a.variant;
        EXPECT_EQ(a.lookup.max, b.lookup.max) << a.variant;
        EXPECT_EQ(a.lookup.rms, b.lookup.rms) << a.variant;
        EXPECT_EQ(a.volume_file->on_bytes_front, b.volume_file->on_bytes_front) << a.variant;
    }
    EXPECT_EQ(one.notes, two.notes);
    for (std::size_t c = 0; c < 3; ++c) {
        EXPECT_EQ(one.volume->statistics[c].mean, two.volume->statistics[c].mean);
    }
}

// Curl noise is negative half of the time.
TEST(NoiseVolumeReport, WhatCannotBeStoredIsLeftOutWithANote) {
    const AssetReport report = report_of(
        "[noise.n]\nchannels.Y = {type = 'curl', component = 'z', frequency = 2, octaves = 1}\n"
        "[bake.v]\nasset = 'noise_volume'\nnoise = 'n'\nsize = [8, 8, 8]\n");
    EXPECT_EQ(std::count_if(report.rows.begin(), report.rows.end(),
                            [](const ReportRow& row) {
                                return row.pixel_type == PixelType::unorm8 ||
                                       row.pixel_type == PixelType::unorm16;
                            }),
              0);
    row_of(report, "bin, half", "8x8x8");
    EXPECT_EQ(std::count_if(report.notes.begin(), report.notes.end(),
                            [](const std::string& note) {
                                return note.find("bin, unorm8, 8x8x8: left out") == 0;
                            }),
              1);
}

TEST(NoiseVolumeReport, ABakeThatCannotBeStoredIsDiagnosed) {
    const config::Recipe recipe = recipe_of(
        "[noise.n]\nchannels.Y = {type = 'curl', component = 'z', frequency = 2, octaves = 1}\n"
        "[bake.v]\nasset = 'noise_volume'\nnoise = 'n'\nsize = [8, 8, 8]\n"
        "formats = ['bin']\npixel_type = 'unorm8'\n");
    const auto report = report_asset(recipe, recipe.parameters.bakes.at(0), {.quick = true});
    EXPECT_FALSE(report.value);
    ASSERT_FALSE(report.diagnostics.empty());
    EXPECT_EQ(report.diagnostics[0].code, "E0402");
}

TEST(NoiseVolumeReport, SaysThatAVolumeIsTooLargeToBeMeasured) {
    const AssetReport report = report_of(
        "[noise.n]\nchannels.Y = {type = 'constant', value = 0.5}\n"
        "[bake.v]\nasset = 'noise_volume'\nnoise = 'n'\nsize = [1024, 1024, 64]\nmips = 2\n");
    ASSERT_EQ(report.notes.size(), 2u);
    EXPECT_NE(report.notes[0].find("1024x1024x64: left out"), std::string::npos);
    EXPECT_NE(report.notes[1].find("first level"), std::string::npos);
    for (const ReportRow& row : report.rows) {
        EXPECT_FALSE(row.of_recipe);
        EXPECT_LE(row.size[0], 512);
    }
}

TEST(NoiseVolumeReport, AnInterruptionLeavesNeitherValueNorDiagnostics) {
    const config::Recipe recipe = recipe_of(std::string(kNoise) + kBake);
    for (const std::string_view step : {"timing", "files"}) {
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
