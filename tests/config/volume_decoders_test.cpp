#include <gtest/gtest.h>

#include <array>
#include <string>
#include <vector>

#include "config/assets/asset_kind.h"
#include "config/assets/cloud_distance.h"
#include "config/assets/cloud_volume.h"
#include "config/assets/noise_volume.h"
#include "config/assets/occupancy.h"
#include "tests/config/clouds.h"
#include "tests/config/noises.h"

namespace skybake::config {
namespace {

using testing::cloud_recipe;

NoiseVolumeBake noise_bake(const std::string& keys, const std::string& noise = "") {
    const Recipe recipe = valid(testing::volume_recipe(keys, "type = 'worley'\nfrequency = 1") +
                                "[noise.n]\n" + noise + "\n");
    if (recipe.parameters.bakes.size() != 1) return {};
    return recipe.parameters.bakes[0].as<NoiseVolumeBake>();
}

using Size = std::array<int, 3>;
using Formats = std::vector<FileFormat>;

TEST(NoiseVolumeDecoder, HasTheDefaultsOfTheIssue) {
    const NoiseVolumeBake bake = noise_bake("", "size = [32, 16, 8]");
    EXPECT_EQ(bake.noise, "n");
    EXPECT_EQ(bake.size, (Size{32, 16, 8})) << "the noise's";
    EXPECT_EQ(bake.formats, Formats{FileFormat::exr});
    EXPECT_EQ(bake.pixel_type, PixelType::half);
    EXPECT_EQ(bake.layout, SheetLayout::stack);
    EXPECT_EQ(bake.columns, 0);
    EXPECT_EQ(bake.mips, 1);
    EXPECT_EQ(bake.compression, Compression::zip);
    EXPECT_EQ(bake.vdb_compression, VdbCompression::blosc);
}

TEST(NoiseVolumeDecoder, ReadsEveryKey) {
    const NoiseVolumeBake bake = noise_bake(
        "size = [64, 32, 16]\nformats = ['vdb', 'exr']\npixel_type = 'float'\nlayout = 'atlas'\n"
        "columns = 4\nmips = 3\ncompression = 'piz'\nvdb_compression = 'none'");
    EXPECT_EQ(testing::to_string(bake), "n [64, 32, 16] 0 1 4 3 3 0 1 0");
    EXPECT_EQ(noise_bake("formats = 'bin'\npixel_type = 'unorm8'").formats,
              Formats{FileFormat::bin});
    EXPECT_EQ(noise_bake("formats = ['bin']\npixel_type = 'unorm16'").pixel_type,
              PixelType::unorm16);
}

TEST(NoiseVolumeDecoder, AllLevelsGoDownToOneVoxel) {
    EXPECT_EQ(noise_bake("mips = 'all'").mips, 8);
    EXPECT_EQ(noise_bake("mips = 'all'\nsize = [1, 1, 1]").mips, 1);
    EXPECT_EQ(noise_bake("mips = 'all'\nsize = [5, 300, 7]").mips, 9);
    EXPECT_TRUE(noise_bake("flip = true\nformats = ['bin', 'exr']").flip);
    EXPECT_EQ(noise_bake("mips = 'all'\nsize = [16384, 4, 1]", "").mips, 15);
    EXPECT_EQ(noise_bake("mips = 8").mips, 8);
}

TEST(NoiseVolumeDecoder, AllowsLargeVolumes) {
    EXPECT_EQ(noise_bake("size = [4096, 4096, 4096]\nformats = 'bin'").size[0], 4096)
        << "2^36 voxels are allowed";
}

TEST(NoiseVolumeDecoder, ColumnsAreOfAnAtlas) {
    EXPECT_EQ(noise_bake("layout = 'atlas'\ncolumns = 128").columns, 128);
    EXPECT_EQ(noise_bake("layout = 'atlas'").columns, 0);
}

// Nobody has said how: then so that engines can import it.
TEST(NoiseVolumeDecoder, AStackThatWouldBeTooHighIsAnAtlas) {
    const NoiseVolumeBake high = noise_bake("size = [64, 256, 128]");
    EXPECT_EQ(high.layout, SheetLayout::atlas);
    EXPECT_EQ(high.columns, 0) << "each level chooses its own";
    EXPECT_EQ(noise_bake("size = [64, 128, 128]").layout, SheetLayout::stack) << "16384 rows fit";
    EXPECT_EQ(noise_bake("size = [64, 256, 128]\nformats = 'bin'").layout, SheetLayout::stack);
}

TEST(NoiseVolumeDecoder, SlicesThatFitStandInOneRow) {
    EXPECT_EQ(noise_bake("layout = 'atlas'\nsize = [64, 64, 131]").layout, SheetLayout::atlas)
        << "in one row";
}

// A bake with these keys, and its cloud.
std::string volume_recipe(const std::string& bake, const std::string& cloud = "") {
    return "[bake.c]\nasset = 'cloud_volume'\ncloud = 'c'\n" + bake + "\n" + cloud_recipe(cloud);
}

CloudVolumeBake volume(const std::string& bake) {
    const Recipe recipe = valid(volume_recipe(bake));
    if (recipe.parameters.bakes.size() != 1) return {};
    return recipe.parameters.bakes[0].as<CloudVolumeBake>();
}

TEST(CloudVolumeDecoder, HasItsDefaults) {
    EXPECT_EQ(testing::to_string(volume("size = [32, 64, 16]")), "c [32, 64, 16] 1 0 0 1 1 2 1");
}

TEST(CloudVolumeDecoder, ReadsEveryKey) {
    EXPECT_EQ(testing::to_string(
                  volume("size = [32, 64, 16]\nformats = ['vdb', 'exr']\npixel_type = 'float'\n"
                         "layout = 'atlas'\ncolumns = 4\nmips = 'all'\ncompression = 'piz'\n"
                         "vdb_compression = 'none'")),
              "c [32, 64, 16] 0 1 4 7 3 0 1 0");
    EXPECT_EQ(volume("size = [16, 16, 16]\nformats = 'bin'\npixel_type = 'unorm8'").pixel_type,
              PixelType::unorm8);
}

// The cloud is 1 km by 2 km by 500 m.
TEST(CloudVolumeDecoder, VoxelsHaveASize) {
    EXPECT_EQ(volume("voxel_size = '10 m'").size, (Size{100, 200, 50}));
    EXPECT_EQ(volume("voxel_size = '10 m'").extent[0].meters, 0) << "the cloud's";
    const Recipe recipe = valid(volume_recipe("voxel_size = '10 m'"));
    EXPECT_EQ(testing::value_at(recipe, "bake.c.size").origin, "derived");
    EXPECT_EQ(testing::all_parameters(recipe).find("voxel_size"), std::string::npos);
    EXPECT_EQ(valid(volume_recipe("size = [16, 16, 16]"), {"bake.c.voxel_size=50 m"})
                  .parameters.bakes[0]
                  .as<CloudVolumeBake>()
                  .size,
              (Size{20, 40, 10}))
        << "a later source chooses";
}

// The bake of a recipe that earns this warning.
CloudVolumeBake warned(const std::string& keys, const std::string& code) {
    const auto outcome = parse(volume_recipe(keys));
    EXPECT_EQ(outcome.diagnostics.size(), 1u) << keys;
    for (const Diagnostic& diagnostic : outcome.diagnostics) {
        EXPECT_EQ(diagnostic.code, code) << diagnostic.message;
        EXPECT_EQ(diagnostic.severity, Severity::warning);
        EXPECT_EQ(diagnostic.where.line, 4);
    }
    if (!outcome.value) return {};
    return outcome.value->parameters.bakes.at(0).as<CloudVolumeBake>();
}

void expect_extent(const CloudVolumeBake& bake, double x, double y, double z) {
    EXPECT_DOUBLE_EQ(bake.extent[0].meters, x);
    EXPECT_DOUBLE_EQ(bake.extent[1].meters, y);
    EXPECT_DOUBLE_EQ(bake.extent[2].meters, z);
}

TEST(CloudVolumeDecoder, VoxelsAreOfExactlyThatSize) {
    const CloudVolumeBake thirty = warned("voxel_size = '30 m'", "W0210");
    EXPECT_EQ(thirty.size, (Size{34, 67, 17})) << "rounded up";
    expect_extent(thirty, 1020, 2010, 510);
    const CloudVolumeBake large = warned("voxel_size = '70 m'\nformats = 'bin'", "W0210");
    EXPECT_EQ(large.size, (Size{15, 29, 8}));
    expect_extent(large, 1050, 2030, 560);
}

// 0.1 is no double, and 500 / 0.1 and the like are whole numbers but for rounding.
TEST(CloudVolumeDecoder, RoundingIsNoPartOfAVoxel) {
    for (int i = 1; i <= 100; ++i) {
        const double edge = i / 10.0;  // nearest to i tenths
        for (int count = 1; count <= 1000; ++count) {
            const double extent = i * count / 10.0;
            const WholeVoxels voxels = whole_voxels({extent}, {edge});
            ASSERT_EQ(voxels.count, count) << edge;
            ASSERT_FALSE(voxels.longer) << edge;
            const WholeVoxels more = whole_voxels({extent * (1 + 1e-12)}, {edge});
            ASSERT_EQ(more.count, count + 1) << edge;
            ASSERT_TRUE(more.longer) << edge;
        }
    }
    EXPECT_EQ(whole_voxels({1e-3}, {1e8}).count, 1);
}

// So they are in files: by size and extent, which make the same volume again.
TEST(CloudVolumeDecoder, TheLongerExtentIsRecorded) {
    const Recipe once = testing::valid_with_warnings(volume_recipe("voxel_size = '30 m'"));
    const std::string carried = testing::all_parameters(once);
    EXPECT_NE(carried.find("extent = [\"1020 m\", \"2010 m\", \"510 m\"]"), std::string::npos);
    EXPECT_EQ(carried.find("voxel_size"), std::string::npos);
    const Recipe twice = valid(carried);
    EXPECT_EQ(testing::all_parameters(twice), carried);
    expect_extent(twice.parameters.bakes.at(0).as<CloudVolumeBake>(), 1020, 2010, 510);
}

TEST(CloudVolumeDecoder, WarnsOfVoxelsThatAreNotCubes) {
    EXPECT_EQ(warned("size = [64, 32, 16]", "W0211").size, (Size{64, 32, 16}));
    EXPECT_EQ(volume("size = [64, 32, 16]\nformats = ['exr', 'bin']").size, (Size{64, 32, 16}))
        << "only VDB files state edges";
    EXPECT_EQ(volume("size = [64, 32, 16]\nextent = ['64 m', '32 m', '16 m']").extent[0].meters,
              64);
}

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
    EXPECT_EQ(bake.pixel_type, PixelType::half);
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
    EXPECT_EQ(testing::to_string(occupancy("")), "v  2 1 0 0 1 2 3 1 0 0 1 1 2 0");
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

// 16x32x8 voxels are 8x16x4 cells of 2, and 16x32x8 of 1.
TEST(OccupancyDecoder, LevelsAndColumnsAreThoseOfItsCells) {
    EXPECT_EQ(occupancy("mips = 'all'").mips, 5);
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
    EXPECT_EQ(recipe.parameters.bakes.at(0).as<OccupancyBake>().mips, 4)
        << "24, 12, 6 and 3 cells along x";
}

TEST(OccupancyDecoder, ChannelsAreThoseOfTheVolume) {
    EXPECT_EQ(occupancy("channel = ''").channel, "") << "the first";
}

}  // namespace
}  // namespace skybake::config
