
#include <gtest/gtest.h>

#include "config/assets/noise_volume.h"
#include "tests/config/noises.h"

namespace skybake::config {
namespace {

using testing::valid;
using testing::volume_recipe;

NoiseVolumeBake volume(const std::string& keys, const std::string& noise = "") {
    const Recipe recipe =
        valid(volume_recipe(keys, "type = 'worley'\nfrequency = 1") + "[noise.n]\n" + noise + "\n");
    if (recipe.parameters.bakes.size() != 1) return {};
    return recipe.parameters.bakes[0].as<NoiseVolumeBake>();
}

using Size = std::array<int, 3>;
using Formats = std::vector<FileFormat>;

TEST(NoiseVolumeDecoder, HasTheDefaultsOfTheIssue) {
    const NoiseVolumeBake bake = volume("", "size = [32, 16, 8]");
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
    const NoiseVolumeBake bake = volume(
        "size = [64, 32, 16]\nformats = ['vdb', 'exr']\npixel_type = 'float'\nlayout = 'atlas'\n"
        "columns = 4\nmips = 3\ncompression = 'piz'\nvdb_compression = 'none'");
    EXPECT_EQ(testing::to_string(bake), "n [64, 32, 16] 0 1 4 3 3 0 1 0");
    EXPECT_EQ(volume("formats = 'bin'\npixel_type = 'unorm8'").formats, Formats{FileFormat::bin});
    EXPECT_EQ(volume("formats = ['bin']\npixel_type = 'unorm16'").pixel_type, PixelType::unorm16);
}

TEST(NoiseVolumeDecoder, AllLevelsGoDownToOneVoxel) {
    EXPECT_EQ(volume("mips = 'all'").mips, 8);
    EXPECT_EQ(volume("mips = 'all'\nsize = [1, 1, 1]").mips, 1);
    EXPECT_EQ(volume("mips = 'all'\nsize = [5, 300, 7]").mips, 9);
    EXPECT_TRUE(volume("flip = true\nformats = ['bin', 'exr']").flip);
    EXPECT_EQ(volume("mips = 'all'\nsize = [16384, 4, 1]", "").mips, 15);
    EXPECT_EQ(volume("mips = 8").mips, 8);
}

TEST(NoiseVolumeDecoder, AllowsLargeVolumes) {
    EXPECT_EQ(volume("size = [4096, 4096, 4096]\nformats = 'bin'").size[0], 4096)
        << "2^36 voxels are allowed";
}

TEST(NoiseVolumeDecoder, ColumnsAreOfAnAtlas) {
    EXPECT_EQ(volume("layout = 'atlas'\ncolumns = 128").columns, 128);
    EXPECT_EQ(volume("layout = 'atlas'").columns, 0);
}

// Nobody has said how: then so that engines can import it.
TEST(NoiseVolumeDecoder, AStackThatWouldBeTooHighIsAnAtlas) {
    const NoiseVolumeBake high = volume("size = [64, 256, 128]");
    EXPECT_EQ(high.layout, SheetLayout::atlas);
    EXPECT_EQ(high.columns, 0) << "each level chooses its own";
    EXPECT_EQ(volume("size = [64, 128, 128]").layout, SheetLayout::stack) << "16384 rows fit";
    EXPECT_EQ(volume("size = [64, 256, 128]\nformats = 'bin'").layout, SheetLayout::stack);
}

TEST(NoiseVolumeDecoder, SlicesThatFitStandInOneRow) {
    EXPECT_EQ(volume("layout = 'atlas'\nsize = [64, 64, 131]").layout, SheetLayout::atlas)
        << "in one row";
}

}  // namespace
}  // namespace skybake::config
