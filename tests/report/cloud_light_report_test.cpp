// Tests the costs of the size of texels of light, and the gain by fitting them.
#include <gtest/gtest.h>

#include <map>
#include <string>

#include "bakers/report/report.h"
#include "config/recipe/recipe.h"

namespace skybake {
namespace {

TEST(CloudLightReport, FittedTexelsAreNearerThanValuesAtCentres) {
    const auto recipe = config::parse_recipe(
        "[clouds.c]\npreset = \"cumulus_humilis\"\n"
        "[bake.c]\nasset = \"cloud_volume\"\ncloud = \"c\"\nsize = [192, 192, 48]\n"
        "[bake.light]\nasset = \"cloud_light\"\nof = \"c\"\nsun_elevations = \"30 deg\"\n",
        "test");
    ReportOptions options;
    options.quick = true;
    const auto outcome = report_asset(*recipe.value, recipe.value->parameters.bakes[1], options);
    ASSERT_TRUE(outcome.value);
    std::map<std::string, double> rms;
    for (const ReportRow& row : outcome.value->rows) {
        rms[row.family + ", " + row.variant] = row.lookup.rms;
        EXPECT_EQ(row.baseline.empty(), row.family == "fitted");
        EXPECT_EQ(row.of_recipe, row.family == "fitted" && row.variant == "4 voxels a texel");
        EXPECT_GT(row.file_bytes, 0U);
    }
    ASSERT_EQ(rms.size(), 4U);
    EXPECT_LT(rms["fitted, 4 voxels a texel"], rms["at centres, 4 voxels a texel"]);
    EXPECT_LT(rms["fitted, 4 voxels a texel"], rms["fitted, 8 voxels a texel"]);
}

}  // namespace
}  // namespace skybake
