#include "bakers/assets/multiple_scattering/multiple_scattering_table.h"
#include "bakers/field/baked.h"
#include "config/sections/layer.h"

#include <gtest/gtest.h>

#include "bakers/field/interpolation.h"
#include "tests/support/bakes.h"

namespace skybake {
namespace {

Baked bake(const std::string& section, const std::string& preset = "earth_hillaire") {
    return test::without_errors(test::bake_first(
        "preset = \"" + preset + "\"\n[bake.multiple_scattering]\n" +
            (section.find("method") == std::string::npos ? "method = 'converged'\n" : "") +
            (section.find("mapping") == std::string::npos ? "mapping = 'hillaire'\n" : "") +
            section,
        {.threads = 2}));
}

TEST(MultipleScatteringTable, HoldsItsTexelErrorForEachPreset) {
    for (const std::string& preset : test::preset_list()) {
        const Baked table = bake("size = [32, 32]\n", preset);
        EXPECT_LE(table.certificate.texel.max, 0.002 + 1e-6) << preset;
        for (const float value : table.image().texels) EXPECT_GE(value, 0) << preset;
    }
}

TEST(MultipleScatteringTable, AsksForFewerNodesWhereLessIsWanted) {
    const Baked fine = bake("size = [32, 32]\nmax_texel_error = \"0.2 %\"\n");
    const Baked coarse = bake("size = [32, 32]\nmax_texel_error = \"20 %\"\n");
    EXPECT_NE(fine.details, coarse.details);
    EXPECT_LE(coarse.certificate.texel.max, 0.2);
    EXPECT_GT(coarse.certificate.texel.max, 0.002);
}

TEST(MultipleScatteringTable, ConventionsOfItsAxes) {
    const Baked table = bake("size = [32, 32]\n");
    // Column 0 is midnight, the last column noon; row 0 the ground.
    EXPECT_EQ(table.image().texel(0, 0)[0], 0);
    EXPECT_NEAR(table.image().texel(31, 0)[0], 0.0555880, 2e-4);
    EXPECT_NEAR(table.image().texel(31, 0)[2], 0.0707287, 2e-4);
    EXPECT_EQ(table.levels[0].probes.front().at[0].first, "altitude_km");
    EXPECT_EQ(table.levels[0].probes.front().at[1].first, "sun_cos_zenith");
}

TEST(MultipleScatteringTable, TwilightMappingLowersTheLookupError) {
    const Baked classic = bake("size = [32, 32]\n");
    const Baked twilight = bake("size = [32, 32]\nmapping = \"twilight\"\n");
    EXPECT_LT(twilight.certificate.lookup.rms, classic.certificate.lookup.rms);
    EXPECT_FALSE(classic.certificate.advice.empty());
    EXPECT_TRUE(twilight.certificate.advice.empty());
}

TEST(MultipleScatteringTable, MaxErrorTakesTheSmallestTableThatHolds) {
    const Baked table = bake("max_error = \"10 %\"\nmapping = \"twilight\"\n");
    EXPECT_LE(table.certificate.lookup.max, 0.1);
}

TEST(MultipleScatteringTable, GreyTablesHaveOneChannel) {
    const auto outcome = test::bake_first(R"(
        wavelengths = ["550 nm"]
        [atmosphere]
        ground_radius = "6360 km"
        top_radius = "6460 km"
        ground_albedo = 0.3
        [atmosphere.layers.rayleigh]
        profile = "exponential"
        scale_height = "8 km"
        scattering = "1.3558e-5 /m"
        [bake.multiple_scattering]
        method = "converged"
        mapping = "hillaire"
        size = [16, 16]
    )");
    ASSERT_TRUE(outcome.value);
    EXPECT_EQ(outcome.value->channel_names, std::vector<std::string>{"Y"});
    EXPECT_EQ(outcome.value->image().channels, 1);
    EXPECT_GT(outcome.value->image().texel(15, 0)[0], 0.03F);
}

}  // namespace
}  // namespace skybake
