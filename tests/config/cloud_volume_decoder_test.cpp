
#include <gtest/gtest.h>

#include "config/assets/cloud_volume.h"
#include "tests/config/clouds.h"

namespace skybake::config {
namespace {

using testing::cloud_recipe;
using testing::parse;
using testing::valid;

// A bake with these keys, and its cloud.
std::string volume_recipe(const std::string& bake, const std::string& cloud = "") {
    return "[bake.c]\nasset = 'cloud_volume'\ncloud = 'c'\n" + bake + "\n" + cloud_recipe(cloud);
}

CloudVolumeBake volume(const std::string& bake) {
    const Recipe recipe = valid(volume_recipe(bake));
    if (recipe.parameters.bakes.size() != 1) return {};
    return recipe.parameters.bakes[0].as<CloudVolumeBake>();
}

using Size = std::array<int, 3>;

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

}  // namespace
}  // namespace skybake::config
