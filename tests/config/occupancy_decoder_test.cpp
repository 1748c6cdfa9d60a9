#include "config/occupancy_decoder.h"

#include <gtest/gtest.h>

#include "tests/config/clouds.h"

namespace skybake::config {
namespace {

using testing::cloud_recipe;
using testing::only_diagnostic;
using testing::parse;
using testing::valid;

// The occupancy's keys begin on line 4; its volume, of 30x20x10 voxels, stands behind it.
std::string occupancy_recipe(const std::string& keys, const std::string& cloud = "") {
    return "[bake.o]\nasset = 'occupancy'\nof = 'v'\n" + keys +
           "\n[bake.v]\nasset = 'cloud_volume'\ncloud = 'c'\nsize = [30, 20, 10]\n" +
           cloud_recipe(cloud);
}

OccupancyBake occupancy(const std::string& keys, const std::string& cloud = "") {
    const Recipe recipe = valid(occupancy_recipe(keys, cloud));
    if (recipe.parameters.bakes.size() != 2) return {};
    return std::get<OccupancyBake>(recipe.parameters.bakes[0].asset);
}

Diagnostic fault(const std::string& keys, const std::string& cloud = "") {
    return only_diagnostic(occupancy_recipe(keys, cloud));
}

TEST(OccupancyDecoder, HasItsDefaults) {
    EXPECT_EQ(testing::spell(occupancy("")), "v  4 1 0 0 1 2 3 1 0 0 1 1 2 0");
}

TEST(OccupancyDecoder, ReadsEveryKey) {
    EXPECT_EQ(testing::spell(
                  occupancy("channel = 'Y'\ncell = 8\nfilter = 'tricubic'\nrule = 'thesis'\n"
                            "contents = ['leap', 'occupied', 'maximum']\nformats = ['bin', 'vdb']\n"
                            "pixel_type = 'float'\nlayout = 'atlas'\ncolumns = 2\nmips = 3\n"
                            "compression = 'none'\nvdb_compression = 'zip'")),
              "v Y 8 2 1 1 0 3 0 1 2 3 0 1 2 1");
    EXPECT_EQ(occupancy("contents = 'occupied'").contents,
              std::vector<OccupancyContent>{OccupancyContent::occupied});
    EXPECT_EQ(occupancy("filter = 'nearest'").filter, OccupancyFilter::nearest);
}

TEST(OccupancyDecoder, CellsArePowersOfTwo) {
    for (const int cell : {1, 2, 4, 8, 16}) {
        EXPECT_EQ(occupancy(fmt::format("cell = {}", cell)).cell, cell);
    }
    EXPECT_EQ(fault("cell = 3").code, "E0110");
    EXPECT_EQ(fault("cell = 3").label, "must be one of 1, 2, 4, 8, 16");
    EXPECT_EQ(fault("cell = 0").code, "E0110");
    EXPECT_EQ(fault("cell = 32").code, "E0110");
    EXPECT_EQ(fault("cell = '4'").code, "E0103");
}

// 30x20x10 voxels are 8x5x3 cells of 4, and 30x20x10 of 1.
TEST(OccupancyDecoder, LevelsAndColumnsAreThoseOfItsCells) {
    EXPECT_EQ(occupancy("mips = 'all'").mips, 4);
    EXPECT_EQ(occupancy("mips = 'all'\ncell = 1").mips, 6);
    EXPECT_EQ(occupancy("mips = 'all'\ncell = 16").mips, 2);
    EXPECT_EQ(fault("mips = 5").label, "8x5x3 has 4 levels down to one voxel");
    EXPECT_EQ(occupancy("layout = 'atlas'\ncolumns = 3").columns, 3);
    EXPECT_EQ(fault("layout = 'atlas'\ncolumns = 4").label, "there are 3 slices");
    EXPECT_EQ(fault("pixel_type = 'unorm8'").code, "E0131");
}

TEST(OccupancyDecoder, ContentsMakeAPicture) {
    EXPECT_EQ(fault("contents = ['occupied', 'leap']").code, "E0129");
    EXPECT_EQ(fault("contents = ['occupied', 'leap']").where.line, 4);
    EXPECT_EQ(fault("contents = ['leap', 'leap', 'occupied']").code, "E0108");
    EXPECT_EQ(fault("contents = []").code, "E0108");
    EXPECT_EQ(fault("contents = ['minimun']").label, "did you mean `minimum`?");
}

TEST(OccupancyDecoder, ItIsOfACloudVolume) {
    const Diagnostic slip =
        only_diagnostic(occupancy_recipe("") + "[bake.p]\nasset = 'occupancy'\nof = 'w'\n");
    EXPECT_EQ(slip.code, "E0133");
    EXPECT_EQ(slip.message, "`bake.p.of`: the recipe has no [bake.w]");
    EXPECT_EQ(slip.label, "this recipe has v");
    const Diagnostic other =
        only_diagnostic(occupancy_recipe("") + "[bake.p]\nasset = 'occupancy'\nof = 'o'\n");
    EXPECT_EQ(other.code, "E0133");
    EXPECT_EQ(other.message, "`bake.p.of` must name a cloud_volume, and [bake.o] is another asset");
    EXPECT_EQ(only_diagnostic("[noise.n.channels.Y]\ntype = 'worley'\n[bake.occupancy]\nof = 'x'\n")
                  .label,
              "the recipe has no [bake.NAME] with asset = \"cloud_volume\"");
    EXPECT_EQ(only_diagnostic("[noise.n.channels.Y]\ntype = 'worley'\n[bake.occupancy]\n").code,
              "E0105");
    // A volume at fault is reported once, as itself.
    EXPECT_EQ(only_diagnostic("[noise.n.channels.Y]\ntype = 'worley'\n[bake.o]\n"
                              "asset = 'occupancy'\nof = 'v'\n[bake.v]\nasset = 'cloud_volumes'\n")
                  .code,
              "E0118");
    EXPECT_EQ(fault("", "noise_scale = 0").code, "E0110");
}

TEST(OccupancyDecoder, ChannelsAreThoseOfTheVolume) {
    const Diagnostic diagnostic = fault("channel = 'R'");
    EXPECT_EQ(diagnostic.code, "E0134");
    EXPECT_EQ(diagnostic.message, "`bake.o.channel`: `v` has no channel `R`");
    EXPECT_EQ(diagnostic.label, "channel is Y");
    EXPECT_EQ(occupancy("channel = ''").channel, "") << "the first";
}

TEST(OccupancyDecoder, ChannelsOfSeveralAreTheNoises) {
    const auto code = [](const std::string& channel, const std::string& pack) {
        const auto diagnostics =
            parse("[bake.o]\nasset = 'occupancy'\nof = 'v'\nchannel = '" + channel +
                  "'\n[bake.v]\nasset = 'cloud_volume'\ncloud = 'c'\nsize = [64, 64, 64]\n"
                  "[clouds.c]\nnoise = 'd'\nchannels = 'noise'\nextent = ['1 m', '1 m', '1 m']\n"
                  "[noise.d]\npreset = 'nubis_detail'\n" +
                  pack)
                .diagnostics;
        return diagnostics.empty() ? "none" : diagnostics[0].code;
    };
    EXPECT_EQ(code("B", ""), "none");
    EXPECT_EQ(code("A", ""), "E0134");
    EXPECT_EQ(code("Y", ""), "E0134");
    EXPECT_EQ(code("Y", "pack = 'detail'\n"), "none");
    EXPECT_EQ(code("B", "pack = 'detail'\n"), "E0134");
}

}  // namespace
}  // namespace skybake::config
