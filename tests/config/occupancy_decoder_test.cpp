
#include <gtest/gtest.h>

#include <array>
#include <tuple>

#include "config/assets/asset_kind.h"
#include "config/assets/cloud_volume.h"
#include "config/assets/occupancy.h"
#include "tests/config/clouds.h"

namespace skybake::config {
namespace {

using testing::cloud_recipe;
using testing::only_diagnostic;
using testing::parse;
using testing::valid;

// The occupancy's keys begin on line 4; its volume, of 16x32x8 voxels, stands behind it.
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

Diagnostic fault(const std::string& keys, const std::string& cloud = "") {
    return only_diagnostic(occupancy_recipe(keys, cloud));
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
    EXPECT_EQ(fault("cell = 3").code, "E0110");
    EXPECT_EQ(fault("cell = 3").label, "must be one of 1, 2, 4, 8, 16");
    EXPECT_EQ(fault("cell = 0").code, "E0110");
    EXPECT_EQ(fault("cell = 32").code, "E0110");
    EXPECT_EQ(fault("cell = '4'").code, "E0103");
}

// 16x32x8 voxels are 4x8x2 cells of 4, and 16x32x8 of 1.
TEST(OccupancyDecoder, LevelsAndColumnsAreThoseOfItsCells) {
    EXPECT_EQ(occupancy("mips = 'all'").mips, 4);
    EXPECT_EQ(occupancy("mips = 'all'\ncell = 1").mips, 6);
    EXPECT_EQ(occupancy("mips = 'all'\ncell = 16").mips, 2);
    EXPECT_EQ(fault("mips = 5").label, "4x8x2 has 4 levels down to one voxel");
    EXPECT_EQ(occupancy("layout = 'atlas'\ncolumns = 2").columns, 2);
    EXPECT_EQ(fault("layout = 'atlas'\ncolumns = 4").label, "the volume has 2 slices");
    EXPECT_EQ(fault("pixel_type = 'unorm8'").code, "E0131");
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

// The diagnostics of an occupancy of a volume of this size, whose voxels are cubes of a metre; not
// that small volumes have few of them for a lattice cell.
std::vector<Diagnostic> of_size(int x, int y, int z, const std::string& keys) {
    auto diagnostics =
        parse(fmt::format("[bake.o]\nasset = 'occupancy'\nof = 'v'\n{}\n[bake.v]\n"
                          "asset = 'cloud_volume'\ncloud = 'c'\nsize = [{}, {}, {}]\n"
                          "[clouds.c]\nnoise = 'n'\nextent = ['{} m', '{} m', '{} m']\n"
                          "[noise.n.channels.Y]\ntype = 'worley'\nfrequency = 1\n",
                          keys, x, y, z, x, y, z))
            .diagnostics;
    std::erase_if(diagnostics, [](const Diagnostic& one) { return one.code == "W0203"; });
    return diagnostics;
}

// Where three tiles of 10 voxels lie side by side, the third begins at voxel 20. With cells of 4, repeated
// as 3 texels that span 12 voxels each, a runtime would look it up in the texels of voxels 8 to 12.
TEST(OccupancyDecoder, CellsTileAsTheVolumeDoes) {
    for (const auto& [x, y, axis] : {std::tuple{10, 16, 'x'}, std::tuple{16, 10, 'y'}}) {
        const auto diagnostics = of_size(x, y, 8, "cell = 4");
        ASSERT_EQ(diagnostics.size(), 1u);
        EXPECT_EQ(diagnostics[0].code, "E0150");
        EXPECT_EQ(diagnostics[0].where.line, 4);
        EXPECT_EQ(diagnostics[0].message,
                  fmt::format("cells of 4 voxels do not tile the 10 voxels of `v` along {}", axis));
        EXPECT_TRUE(of_size(x, y, 8, "cell = 2").empty());
    }
    EXPECT_EQ(of_size(10, 16, 8, "").at(0).where.line, 3) << "the default is of no line";
    EXPECT_TRUE(of_size(16, 16, 10, "cell = 4").empty()) << "the height does not repeat";
    EXPECT_TRUE(of_size(3, 4, 10, "cell = 4").empty()) << "one cell is the same everywhere";
}

// 12 cells are 6, then 3, which have no half.
TEST(OccupancyDecoder, LevelsHalveTheCells) {
    for (const auto& size :
         {std::array{48, 16, 16}, std::array{16, 48, 16}, std::array{16, 16, 48}}) {
        EXPECT_TRUE(of_size(size[0], size[1], size[2], "mips = 3").empty());
        const auto diagnostics = of_size(size[0], size[1], size[2], "mips = 4");
        ASSERT_EQ(diagnostics.size(), 1u);
        EXPECT_EQ(diagnostics[0].code, "E0150");
        EXPECT_EQ(diagnostics[0].label, "use at most 3 levels, or another size");
    }
    EXPECT_TRUE(of_size(64, 16, 4, "mips = 'all'").empty()) << "1 stays 1";
    // Cells that cannot be halved further end "all": 12 x 8 x 4 cells have 3, 6 and 12 levels of them.
    EXPECT_TRUE(of_size(48, 32, 16, "mips = 'all'").empty());
    const Recipe recipe = testing::valid_with_warnings(
        "[bake.o]\nasset = 'occupancy'\nof = 'v'\nmips = 'all'\n[bake.v]\nasset = 'cloud_volume'\n"
        "cloud = 'c'\nsize = [48, 32, 16]\n" + cloud_recipe(""));
    EXPECT_EQ(recipe.parameters.bakes.at(0).as<OccupancyBake>().mips, 3) << "12, 6 and 3 cells along x";
}

TEST(OccupancyDecoder, WarnsOfCellsThatAreNotCubes) {
    const std::string volume =
        "[bake.v]\nasset = 'cloud_volume'\ncloud = 'c'\nformats = 'bin'\n"
        "size = [16, 16, 16]\n";
    const std::string grid = "[bake.o]\nasset = 'occupancy'\nof = 'v'\n";
    EXPECT_TRUE(parse(grid + volume + cloud_recipe("")).diagnostics.empty());
    const Diagnostic warning =
        only_diagnostic(grid + "formats = 'vdb'\n" + volume + cloud_recipe(""));
    EXPECT_EQ(warning.code, "W0211");
    EXPECT_EQ(warning.message, "the voxels of [bake.o] are not cubes: 250 x 500 x 125 m");
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
