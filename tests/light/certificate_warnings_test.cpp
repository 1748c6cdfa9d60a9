#include "bakers/assets/description/certificate_warnings.h"
#include "bakers/field/baked.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "bakers/assets/registry/registry.h"
#include "config/diagnostics/diagnostic_codes.h"
#include "tests/support/atmospheres.h"

namespace skybake {
namespace {

using test::codes_of;

Baked certified(const std::string& kind) {
    Baked baked;
    baked.name = "sky";
    baked.kind = kind;
    baked.certified = true;
    baked.pixel_type = config::PixelType::half;
    return baked;
}

struct Bound {
    const char* code;
    double bound;
    std::function<double&(Certificate&)> figure;
};

TEST(CertificateWarnings, EachFigureHasItsBound) {
    const std::vector<Bound> bounds = {
        {"W0220 ", 0.05, [](Certificate& c) -> double& { return c.texel.rms; }},
        {"W0214 ", 0.3, [](Certificate& c) -> double& { return c.lookup.rms; }},
        {"W0221 ", 0.1, [](Certificate& c) -> double& { return c.sky->median; }},
        {"W0222 ", 0.03, [](Certificate& c) -> double& { return c.color->ninth_decile; }},
        {"W0222 ", 0.05, [](Certificate& c) -> double& { return c.color->disc[0]; }},
        {"W0222 ", 0.05, [](Certificate& c) -> double& { return c.color->disc[1]; }}};
    for (const Bound& bound : bounds) {
        for (const double share : {0.99, 1.01, -1.01}) {
            if (share < 0 && bound.bound != 0.05) continue;  // a disc may be too dark
            Baked baked = certified("sky_view");
            baked.certificate.sky = SkyError{};
            baked.certificate.sky->points = 10;
            baked.certificate.color = ColorError{};
            bound.figure(baked.certificate) = share * bound.bound;
            const auto warnings = warn_of_large_errors({}, baked);
            const bool is_large = share > 1 || (share < -1 && bound.code[4] == '2');
            EXPECT_EQ(codes_of(warnings), is_large ? bound.code : "") << bound.code << share;
            EXPECT_EQ(baked.certificate.advice.empty(), !is_large) << bound.code << share;
            for (const auto& warning : warnings) {
                EXPECT_EQ(warning.severity, config::Severity::warning);
                EXPECT_FALSE(warning.label.empty());
                EXPECT_NE(config::find_diagnostic_code(warning.code), nullptr);
            }
        }
    }
}

TEST(CertificateWarnings, WhatWasNotMeasuredIsNotJudged) {
    Baked baked = certified("sky_view");
    baked.certificate.texel.rms = 1;
    baked.certified = false;
    EXPECT_EQ(codes_of(warn_of_large_errors({}, baked)), "");
    baked.certified = true;
    baked.certificate.texel.rms = std::nan("");
    EXPECT_EQ(codes_of(warn_of_large_errors({}, baked)), "W0220 ");
}

// More texels do not help where texels are as far off as lookups.
TEST(CertificateWarnings, LookupsOfWrongTexelsAreNoMatterOfSize) {
    Baked baked = certified("sky_view");
    baked.certificate.texel.rms = 0.4;
    baked.certificate.lookup.rms = 0.6;
    EXPECT_EQ(codes_of(warn_of_large_errors({}, baked)), "W0220 ");
    baked.certificate.texel.rms = 0.06;
    EXPECT_EQ(codes_of(warn_of_large_errors({}, baked)), "W0220 W0214 ");
}

TEST(CertificateWarnings, AdviceIsOfTheAsset) {
    const auto advice = [](const std::string& kind, config::PixelType type,
                           const std::string& better, std::size_t wavelengths, double color) {
        Baked baked = certified(kind);
        baked.pixel_type = type;
        baked.levels.emplace_back();
        baked.levels[0].statistics.resize(2);
        baked.levels[0].statistics[0].max = 0.1255;
        baked.certificate.sky = SkyError{};
        baked.certificate.sky->points = 10;
        baked.certificate.sky->median = color > 0 ? 0 : 0.2;
        baked.certificate.sky->better = better;
        baked.certificate.color = ColorError{.ninth_decile = color};
        config::Parameters parameters;
        parameters.wavelengths.resize(wavelengths);
        warn_of_large_errors(parameters, baked);
        return baked.certificate.advice;
    };
    using config::PixelType;
    const auto has = [](const std::string& text, const char* word) {
        EXPECT_NE(text.find(word), std::string::npos) << text;
    };
    has(advice("environment", PixelType::unorm8, "", 4, 0), "pixel_type = \"half\"");
    has(advice("environment", PixelType::unorm8, "", 4, 0), "is step 32 of 255");
    has(advice("multiple_scattering", PixelType::half, "content = \"moments\" is", 4, 0),
        "moments");
    has(advice("multiple_scattering", PixelType::half, "", 4, 0), "sky_view");
    has(advice("aerial_perspective", PixelType::half, "", 4, 0), "slices");
    has(advice("sky_view", PixelType::half, "", 4, 0.1), "best 8");
    has(advice("sky_view", PixelType::half, "", 8, 0.1), "best 16");
    has(advice("sky_view", PixelType::half, "", 16, 0.1), "none");
}

// Files of eight bits, whose steps are as large as most of a sky's light.
TEST(CertificateWarnings, SkiesOfEightBitsAreWarnedOf) {
    const auto codes = [](const std::string& type) {
        const config::Recipe recipe = test::recipe_of(
            "preset = 'earth_hillaire'\n[bake.environment]\nsun_elevation = '30 deg'\n"
            "size = [64, 32]\n" +
            type);
        auto baked = bake_asset(recipe, recipe.parameters.bakes.at(0), {.threads = 2});
        EXPECT_TRUE(baked.value);
        EXPECT_EQ(baked.value->certificate.advice.empty(), baked.diagnostics.empty());
        return codes_of(baked.diagnostics);
    };
    EXPECT_EQ(codes("formats = ['png']\npixel_type = 'unorm8'\n"), "W0220 ");
    EXPECT_EQ(codes("pixel_type = 'half'\n"), "");
}

// No path finds light of a sun 12 degrees below the horizon. What was not found is no certainty.
TEST(CertificateWarnings, WherePathsFindNothingNothingIsClaimed) {
    const auto sky = [](const std::string& recipe_text) {
        const config::Recipe recipe = test::recipe_of(recipe_text);
        auto baked = bake_asset(recipe, recipe.parameters.bakes.at(0), {.threads = 2});
        EXPECT_TRUE(baked.value);
        return std::move(baked.value->certificate);
    };
    const Certificate night =
        sky("preset = 'earth_hillaire'\n[bake.sky_view]\nsize = [16, 16]\nsun_elevations = ['-12 "
            "deg']\n");
    ASSERT_TRUE(night.sky);
    EXPECT_EQ(night.sky->points, 0);
    EXPECT_GT(night.sky->left_out, 0);
    EXPECT_NE(night.advice, "");
    // Without air nothing is scattered, and the ground that is seen is certain.
    const Certificate moon =
        sky("preset = 'vacuum'\n[bake.sky_view]\nsize = [16, 16]\nsun_elevations = ['20 deg']\n");
    ASSERT_TRUE(moon.sky);
    EXPECT_GT(moon.sky->points, 0);
    EXPECT_EQ(moon.sky->standard_error, 0);
}

}  // namespace
}  // namespace skybake
