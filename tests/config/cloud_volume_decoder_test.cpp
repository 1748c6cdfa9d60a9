
#include <gtest/gtest.h>

#include "config/assets/cloud_volume.h"
#include "tests/config/clouds.h"

namespace skybake::config {
namespace {

using testing::cloud_recipe;
using testing::only_diagnostic;
using testing::parse;
using testing::valid;

// The bake's keys begin on line 4.
std::string volume_recipe(const std::string& bake, const std::string& cloud = "") {
    return "[bake.c]\nasset = 'cloud_volume'\ncloud = 'c'\n" + bake + "\n" + cloud_recipe(cloud);
}

CloudVolumeBake volume(const std::string& bake) {
    const Recipe recipe = valid(volume_recipe(bake));
    if (recipe.parameters.bakes.size() != 1) return {};
    return recipe.parameters.bakes[0].as<CloudVolumeBake>();
}

Diagnostic fault(const std::string& bake, const std::string& cloud = "") {
    return only_diagnostic(volume_recipe(bake, cloud));
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
    const Diagnostic small = fault("voxel_size = '1 cm'");
    EXPECT_EQ(small.code, "E0110");
    EXPECT_EQ(small.message, "`bake.c.voxel_size` makes 100000 voxels along x");
    EXPECT_EQ(small.label, "at most 16384 of 1000 m are allowed");
    EXPECT_EQ(small.where.line, 4);
    EXPECT_EQ(fault("voxel_size = '10 m'\nsize = [16, 16, 16]").code, "E0109");
    EXPECT_EQ(fault("").code, "E0105");
    EXPECT_EQ(fault("").message, "`bake.c.size` is missing");
    EXPECT_EQ(fault("").label, "give voxel_size = \"5 m\", or size");
    std::string odd = volume_recipe("");
    odd.replace(odd.find("2 km"), 4, "1234.567 m");
    EXPECT_EQ(only_diagnostic(odd).label,
              "give size, the voxels along each axis, or voxel_size, the edge of cubes");
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
    EXPECT_EQ(
        fault("voxel_size = '30 m'").message,
        "`bake.c.voxel_size` does not divide the extent of cloud `c`: 1000 m x 2000 m x 500 m "
        "becomes 1020 m x 2010 m x 510 m");
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
    EXPECT_EQ(fault("voxel_size = '10 m'\nextent = ['1 km', '1 km', '1 km']").code, "E0109");
}

TEST(CloudVolumeDecoder, WarnsOfVoxelsThatAreNotCubes) {
    EXPECT_EQ(warned("size = [64, 32, 16]", "W0211").size, (Size{64, 32, 16}));
    EXPECT_EQ(fault("size = [64, 32, 16]").message,
              "the voxels of [bake.c] are not cubes: 15.625 x 62.5 x 31.25 m");
    EXPECT_EQ(volume("size = [64, 32, 16]\nformats = ['exr', 'bin']").size, (Size{64, 32, 16}))
        << "only VDB files state edges";
    EXPECT_EQ(volume("size = [64, 32, 16]\nextent = ['64 m', '32 m', '16 m']").extent[0].meters,
              64);
}

TEST(CloudVolumeDecoder, ItsCloudIsThere) {
    const Diagnostic slip = only_diagnostic(
        cloud_recipe("") + "[bake.x]\nasset = 'cloud_volume'\ncloud = 'd'\nsize = [8, 8, 8]\n");
    EXPECT_EQ(slip.code, "E0132");
    EXPECT_EQ(slip.message, "`bake.x.cloud`: the recipe has no [clouds.d]");
    EXPECT_EQ(slip.label, "this recipe has c");
    EXPECT_EQ(
        only_diagnostic("[bake.x]\nasset = 'cloud_volume'\ncloud = 'd'\nsize = [8, 8, 8]\n").label,
        "the recipe has no [clouds.NAME]");
    EXPECT_EQ(only_diagnostic("[noise.n.channels.Y]\ntype = 'worley'\n[clouds]\nc = 3\n[bake.x]\n"
                              "asset = 'cloud_volume'\ncloud = 'c'\nvoxel_size = '1 m'\n")
                  .code,
              "E0103");
}

TEST(CloudVolumeDecoder, FilesAreThoseOfVolumes) {
    EXPECT_EQ(fault("size = [16384, 16384, 16384]\nformats = 'bin'").code, "E0126");
    EXPECT_EQ(fault("size = [16, 32, 8]\nmips = 7").code, "E0110");
    EXPECT_EQ(fault("size = [16, 32, 8]\npixel_type = 'unorm8'").code, "E0131");
    EXPECT_EQ(fault("size = [16, 32, 8]\nlayout = 'atlas'\ncolumns = 9").label,
              "the volume has 8 slices");
    EXPECT_EQ(fault("size = [8, 8, 16385]").code, "E0110");
}

// The noise has two cells a tile.
TEST(CloudVolumeDecoder, OctavesAreScaled) {
    EXPECT_EQ(volume("size = [16, 32, 8]").size[0], 16);
    const Diagnostic coarse = fault("size = [16, 32, 8]", "noise_scale = [3, 1, 1]");
    EXPECT_EQ(coarse.code, "W0203");
    EXPECT_EQ(coarse.where.line, 4);
    EXPECT_EQ(coarse.message, "1 octave is too fine for 16x32x8: `n` needs 24x32x8");
    const Diagnostic detail = fault("size = [32, 64, 16]", "detail = 'd'\ndetail_scale = 2");
    EXPECT_EQ(detail.code, "W0203") << "of the first channel alone";
    EXPECT_EQ(detail.message, "2 octaves are too fine for 32x64x16: `d` needs 64x64x64");
    const Diagnostic both =
        fault("size = [16, 32, 8]", "noise_scale = [3, 1, 1]\ndetail = 'd'\ndetail_scale = 2");
    EXPECT_EQ(both.message,
              "4 octaves are too fine for 16x32x8: `d` needs 64x64x64, `n` needs 24x32x8");
    const auto nothing = parse(
        "[noise.n.channels.Y]\ntype = 'perlin'\nfrequency = 4\n[noise.n]\nsampling = 'corners'\n"
        "[clouds.c]\nnoise = 'n'\nnoise_scale = 8\nextent = ['1 m', '1 m', '1 m']\n"
        "[bake.c]\nasset = 'cloud_volume'\ncloud = 'c'\nsize = [16, 16, 16]\n");
    ASSERT_EQ(nothing.diagnostics.size(), 2u) << "clouds are sampled at the centres of voxels";
    EXPECT_EQ(nothing.diagnostics[0].code, "W0208");
    EXPECT_EQ(nothing.diagnostics[1].code, "W0203");
}

TEST(CloudVolumeDecoder, WarnsOfTowersBetweenVoxels) {
    const auto tower = [](const std::string& name, const std::string& sigma) {
        return "[clouds.c.towers." + name + "]\ncenter = [0, 0]\namplitude = 1\nsigma = " + sigma +
               "\n";
    };
    const std::string size = "size = [100, 50, 16]\nformats = 'bin'";
    const Diagnostic narrow = fault(size, tower("a", "[0.1, 0.1]") + tower("b", "[0.02, 0.019]") +
                                              tower("e", "[0.009, 1]") + tower("f", "[0.009, 1]"));
    EXPECT_EQ(narrow.code, "W0204");
    EXPECT_EQ(narrow.severity, Severity::warning);
    EXPECT_EQ(narrow.where.line, 4);
    EXPECT_EQ(narrow.message,
              "tower b of cloud `c`, like 2 more, is narrower than a voxel at size 100x50x16");
    EXPECT_TRUE(parse(volume_recipe(size, tower("a", "[0.011, 0.021]"))).diagnostics.empty());
    EXPECT_EQ(fault(size, tower("a", "[0.011, 0.021]") + "rotation = '90 deg'").code, "W0204");
    EXPECT_EQ(fault(size, "scatter.count = 1\nscatter.sigma = [0.015, 0.1]").code, "W0204");
    EXPECT_TRUE(parse(volume_recipe(size, "scatter.sigma = [0.015, 0.1]")).diagnostics.empty());
    // Voxels are 10 m and 40 m wide.
    const auto dome = [](const std::string& widths) {
        return "[clouds.c.towers.d]\nshape = 'dome'\nfoot = ['0 m', '0 m', '0 m']\namplitude = 1\n"
               "size = [" +
               widths + ", '1 m']\n";
    };
    EXPECT_TRUE(parse(volume_recipe(size, dome("'41 m', '41 m'"))).diagnostics.empty());
    EXPECT_EQ(fault(size, dome("'41 m', '39 m'")).code, "W0204");
    const std::string scatter = "[clouds.c.scatter]\nshape = 'dome'\ncount = 1\nwidth = ";
    EXPECT_EQ(fault(size, scatter + "['39 m', '1 km']\n").code, "W0204");
    EXPECT_TRUE(parse(volume_recipe(size, scatter + "['41 m', '1 km']\n")).diagnostics.empty());
}

}  // namespace
}  // namespace skybake::config
