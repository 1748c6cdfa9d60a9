#include <gtest/gtest.h>

#include <array>
#include <string>
#include <vector>

#include "config/assets/asset_kind.h"
#include "config/assets/cloud_distance.h"
#include "config/assets/cloud_volume.h"
#include "tests/config/clouds.h"

namespace skybake::config {
namespace {

using testing::cloud_recipe;
using testing::only_diagnostic;
using testing::parse;
using testing::valid;

// The distance's keys begin on line 4; its volume, of 16x32x10 voxels, stands behind it.
std::string distance_recipe(const std::string& keys) {
    return "[bake.d]\nasset = 'cloud_distance'\nof = 'v'\n" + keys +
           "\n[bake.v]\nasset = 'cloud_volume'\ncloud = 'c'\nsize = [16, 32, 10]\nformats = "
           "['bin']\n" +
           cloud_recipe("");
}

CloudDistanceBake distance(const std::string& keys) {
    const Recipe recipe = valid(distance_recipe(keys));
    if (recipe.parameters.bakes.size() != 2) return {};
    return recipe.parameters.bakes[0].as<CloudDistanceBake>();
}

Diagnostic fault(const std::string& keys) { return only_diagnostic(distance_recipe(keys)); }

TEST(CloudDistanceDecoder, HasItsDefaults) {
    const CloudDistanceBake bake = distance("");
    EXPECT_EQ(bake.of, "v");
    EXPECT_EQ(bake.channel, "");
    EXPECT_EQ(bake.cell, 4);
    EXPECT_EQ(bake.range, (std::array<Length, 2>{{{-256}, {4096}}}));
    EXPECT_EQ(bake.core.meters, 0);
    EXPECT_EQ(bake.contents, std::vector<DistanceContent>{DistanceContent::distance});
    EXPECT_EQ(bake.pixel_type, PixelType::unorm16);
    EXPECT_EQ(bake.formats, std::vector<FileFormat>{FileFormat::bin});
    EXPECT_EQ(bake.mips, 1);
}

TEST(CloudDistanceDecoder, ReadsEveryKey) {
    const CloudDistanceBake bake = distance(
        "channel = 'Y'\ncell = 8\nrange = ['0 m', '2 km']\ncore = '0.3 km'\n"
        "contents = ['distance', 'density_scale', 'detail_type', 'profile']\n"
        "pixel_type = 'half'\nformats = ['exr']\nmips = 1");
    EXPECT_EQ(bake.channel, "Y");
    EXPECT_EQ(bake.cell, 8);
    EXPECT_EQ(bake.range, (std::array<Length, 2>{{{0}, {2000}}}));
    EXPECT_EQ(bake.core.meters, 300);
    EXPECT_EQ(bake.contents, (std::vector<DistanceContent>{
                                 DistanceContent::distance, DistanceContent::density_scale,
                                 DistanceContent::detail_type, DistanceContent::profile}));
    EXPECT_EQ(bake.pixel_type, PixelType::half);
}

TEST(CloudDistanceDecoder, SaysWhatIsWrong) {
    EXPECT_EQ(fault("cell = 3").code, "E0110");
    EXPECT_EQ(fault("mips = 2").code, "E0110");
    EXPECT_EQ(fault("range = ['10 m', '1 km']").code, "E0175");
    EXPECT_EQ(fault("range = ['-10 m', '0 m']").code, "E0175");
    EXPECT_EQ(fault("contents = ['profile', 'distance', 'detail_type']").code, "E0175");
    EXPECT_EQ(fault("contents = ['distance', 'profile']").code, "E0129");
    EXPECT_EQ(fault("channel = 'B'").code, "E0134");
    EXPECT_EQ(fault("pixel_type = 'bc4'\nformats = ['dds']").code, "E0131");
    EXPECT_EQ(only_diagnostic("[bake.d]\nasset = 'cloud_distance'\nof = 'w'\n").code, "E0133");
}

// 16 voxels are two texels of 8, but no whole number of 16 along x if there are 24.
TEST(CloudDistanceDecoder, TexelsTileTheVolume) {
    const auto recipe = [](const char* size, int cell) {
        return "[bake.d]\nasset = 'cloud_distance'\nof = 'v'\ncell = " + std::to_string(cell) +
               "\n[bake.v]\nasset = 'cloud_volume'\ncloud = 'c'\nsize = " + size +
               "\nformats = ['bin']\n" + cloud_recipe("");
    };
    EXPECT_EQ(only_diagnostic(recipe("[24, 16, 8]", 16)).code, "E0150");
    // One texel for half a tile would repeat with another period.
    EXPECT_EQ(only_diagnostic(recipe("[8, 16, 8]", 16)).code, "E0150");
    EXPECT_EQ(only_diagnostic(recipe("[1, 16, 8]", 16)).message,
              "cells of 16 voxels do not tile the 1 voxel of `v` along x");
    valid(recipe("[32, 16, 8]", 16));
}

// The parameters that its file carries are a recipe.
TEST(CloudDistanceDecoder, FilesCarryARecipe) {
    const Recipe recipe = valid(distance_recipe("core = '100 m'\ncell = 2"));
    ASSERT_EQ(recipe.parameters.bakes.size(), 2u);
    const Bake& bake = recipe.parameters.bakes[0];
    std::vector<Read> reads = kind_of(bake).reads(recipe.parameters, bake);
    reads.push_back({"bake.d", Roles::all()});
    const auto carried = parse(parameters_toml(recipe, reads));
    ASSERT_TRUE(carried.value);
    const auto& read = bake_named(carried.value->parameters, "d").as<CloudDistanceBake>();
    EXPECT_EQ(read.core.meters, 100);
    EXPECT_EQ(read.cell, 2);
}

}  // namespace
}  // namespace skybake::config
