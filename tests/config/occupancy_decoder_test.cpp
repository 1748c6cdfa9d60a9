
#include <gtest/gtest.h>

#include "config/assets/asset_kind.h"
#include "config/assets/cloud_volume.h"
#include "config/assets/occupancy.h"
#include "tests/config/clouds.h"

namespace skybake::config {
namespace {

using testing::cloud_recipe;
using testing::parse;
using testing::valid;

// An occupancy with these keys, and its volume, of 16x32x8 voxels.
std::string occupancy_recipe(const std::string& keys, const std::string& cloud = "") {
    return "[bake.o]\nasset = 'occupancy'\nof = 'v'\n" + keys +
           "\n[bake.v]\nasset = 'cloud_volume'\ncloud = 'c'\nsize = [16, 32, 8]\n" +
           cloud_recipe(cloud);
}

OccupancyBake occupancy(const std::string& keys, const std::string& cloud = "") {
    const Recipe recipe = valid(occupancy_recipe(keys, cloud));
    if (recipe.parameters.bakes.size() != 2) return {};
    return recipe.parameters.bakes[0].as<OccupancyBake>();
}

TEST(OccupancyDecoder, HasItsDefaults) {
    EXPECT_EQ(testing::to_string(occupancy("")), "v  4 1 0 0 1 2 3 1 0 0 1 1 2 0");
}

TEST(OccupancyDecoder, ReadsEveryKey) {
    EXPECT_EQ(testing::to_string(
                  occupancy("channel = 'Y'\ncell = 8\nfilter = 'tricubic'\nrule = 'thesis'\n"
                            "contents = ['leap', 'occupied', 'maximum']\nformats = ['bin', 'vdb']\n"
                            "pixel_type = 'float'\nlayout = 'atlas'\ncolumns = 1\nmips = 3\n"
                            "compression = 'none'\nvdb_compression = 'zip'")),
              "v Y 8 2 1 1 0 3 0 1 1 3 0 1 2 1");
    EXPECT_EQ(occupancy("contents = 'occupied'").contents,
              std::vector<OccupancyContent>{OccupancyContent::occupied});
    EXPECT_EQ(occupancy("filter = 'nearest'").filter, OccupancyFilter::nearest);
}

TEST(OccupancyDecoder, CellsArePowersOfTwo) {
    for (const int cell : {1, 2, 4, 8, 16}) {
        EXPECT_EQ(occupancy(fmt::format("cell = {}", cell)).cell, cell);
    }
}

// 16x32x8 voxels are 4x8x2 cells of 4, and 16x32x8 of 1.
TEST(OccupancyDecoder, LevelsAndColumnsAreThoseOfItsCells) {
    EXPECT_EQ(occupancy("mips = 'all'").mips, 4);
    EXPECT_EQ(occupancy("mips = 'all'\ncell = 1").mips, 6);
    EXPECT_EQ(occupancy("mips = 'all'\ncell = 16").mips, 2);
    EXPECT_EQ(occupancy("layout = 'atlas'\ncolumns = 2").columns, 2);
}

// The parameters that its file carries are a recipe, whose bake can be checked, of any volume: one of
// bytes is no VDB file, which a volume is by default.
TEST(OccupancyDecoder, FilesCarryARecipe) {
    for (const char* files : {"", "pixel_type = 'unorm8'\nformats = ['bin']\n",
                              "pixel_type = 'unorm16'\nformats = ['png']\nmips = 2\n",
                              "pixel_type = 'float'\nformats = ['exr']\n"}) {
        const Recipe recipe = valid("[bake.o]\nasset = 'occupancy'\nof = 'v'\n[bake.v]\n" +
                                    std::string("asset = 'cloud_volume'\ncloud = 'c'\n") +
                                    "size = [16, 32, 8]\n" + files + cloud_recipe(""));
        ASSERT_EQ(recipe.parameters.bakes.size(), 2u) << files;
        const Bake& occupancy = recipe.parameters.bakes[0];
        std::vector<Read> reads = kind_of(occupancy).reads(recipe.parameters, occupancy);
        reads.push_back({"bake.o", Roles::all()});
        const auto carried = parse(parameters_toml(recipe, reads));
        ASSERT_TRUE(carried.value) << files << carried.diagnostics.at(0).message;
        ASSERT_EQ(carried.value->parameters.bakes.size(), 2u) << files;
        const auto& volume = bake_named(carried.value->parameters, "v").as<CloudVolumeBake>();
        EXPECT_EQ(volume.pixel_type,
                  bake_named(recipe.parameters, "v").as<CloudVolumeBake>().pixel_type);
    }
}

// 12 cells are 6, then 3, which have no half.
TEST(OccupancyDecoder, LevelsHalveTheCells) {
    const Recipe recipe = testing::valid_with_warnings(
        "[bake.o]\nasset = 'occupancy'\nof = 'v'\nmips = 'all'\n[bake.v]\nasset = 'cloud_volume'\n"
        "cloud = 'c'\nsize = [48, 32, 16]\n" +
        cloud_recipe(""));
    EXPECT_EQ(recipe.parameters.bakes.at(0).as<OccupancyBake>().mips, 3)
        << "12, 6 and 3 cells along x";
}

TEST(OccupancyDecoder, ChannelsAreThoseOfTheVolume) {
    EXPECT_EQ(occupancy("channel = ''").channel, "") << "the first";
}

}  // namespace
}  // namespace skybake::config
