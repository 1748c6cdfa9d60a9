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
using testing::parse;
using testing::valid;

// A distance with these keys, and its volume, of 16x32x10 voxels.
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
