// Files of write_vdb against OpenVDB's own reader, and against trees that OpenVDB built and wrote.
#include "bakers/io/formats/vdb/vdb_file.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/io/files.h"
#include "tests/io/vdb_samples.h"
#include "tests/io/vdb_trees.h"
#include "tests/support/outcomes.h"
#include "tests/support/volumes.h"

namespace skybake {
namespace {

using config::VdbCompression;
using openvdb::Coord;
using openvdb::FloatGrid;
using namespace testing;

// Volumes of sizes below and beyond each node of a tree, of all types and compressions.
std::vector<Baked> volumes() {
    constexpr std::array kTypes = {PixelType::half, PixelType::float32};
    constexpr std::array kCompressions = {VdbCompression::none, VdbCompression::zip,
                                          VdbCompression::blosc};
    std::vector<Baked> all;
    const std::array<std::array<int, 3>, 5> sizes = {
        {{1, 1, 1}, {7, 13, 5}, {8, 8, 8}, {130, 9, 129}, {9, 136, 40}}};
    const std::array<int, 3> channels = {1, 2, 4};
    for (std::size_t size = 0; size < sizes.size(); ++size) {
        for (std::size_t type = 0; type < 2; ++type) {
            for (std::size_t compression = 0; compression < 3; ++compression) {
                all.push_back(vdb_sample(sizes[size], channels[(size + type + compression) % 3],
                                         kTypes[type], kCompressions[compression]));
            }
        }
    }
    all.push_back(vdb_sample({140, 140, 140}, 1, PixelType::half, VdbCompression::blosc));
    all.push_back(vdb_sample({140, 140, 140}, 1, PixelType::float32, VdbCompression::none));
    // Two children of the root.
    all.push_back(vdb_sample({4100, 3, 2}, 1, PixelType::half, VdbCompression::zip));
    all.push_back(vdb_sample({2, 3, 4100}, 2, PixelType::float32, VdbCompression::blosc));
    return all;
}

TEST(VdbVolume, HoldsWhatOpenVdbWouldAndGivesItBack) {
    for (const Baked& volume : volumes()) {
        EXPECT_EQ(wrong_with(volume), "") << ::testing::PrintToString(volume.levels[0].size);
    }
}

TEST(VdbVolume, GridsSayWhatTheyAre) {
    const TemporaryFolder folder;
    openvdb::initialize();
    for (const Baked& volume : volumes()) {
        ASSERT_TRUE(write_sample(volume, folder / "shape.vdb").value);
        openvdb::io::File file((folder / "shape.vdb").string());
        file.open();
        EXPECT_EQ(file.readAllGridMetadata()->size(), volume.channel_names.size());
        for (const std::string& name : grid_names(volume)) {
            const auto grid = file.readGrid(name);
            EXPECT_TRUE(grid->isType<FloatGrid>());
            EXPECT_EQ(openvdb::gridPtrCast<FloatGrid>(grid)->background(), 0.0F);
            EXPECT_EQ(grid->saveFloatAsHalf(), volume.pixel_type == PixelType::half);
            EXPECT_EQ(grid->metaValue<std::string>("units"), "metres");
            EXPECT_EQ(grid->metaValue<std::string>("up_axis"), "+z");
            EXPECT_TRUE(grid->transform().isLinear());
            EXPECT_TRUE(grid->hasUniformVoxels());
            EXPECT_EQ(grid->indexToWorld(Coord(0)), openvdb::Vec3d(-87.5, 12.75, 10012.5));
            EXPECT_EQ(grid->indexToWorld(Coord(1, 2, 3)), openvdb::Vec3d(-62.5, 62.75, 10087.5));
        }
        EXPECT_EQ(file.getMetadata()->metaValue<std::string>("skybake/kind"), "noise_volume");
    }
}

TEST(VdbVolumeBytes, DependOnNeitherThreadsNorRuns) {
    const TemporaryFolder folder;
    for (const VdbCompression compression : {VdbCompression::none, VdbCompression::blosc}) {
        const Baked volume = vdb_sample({140, 150, 133}, 2, PixelType::half, compression);
        std::vector<std::string> files;
        for (const int threads : {1, 2, 5, 1}) {
            ASSERT_TRUE(write_sample(volume, folder / "v.vdb", threads).value.has_value());
            files.push_back(testing::read_bytes(folder / "v.vdb"));
        }
        for (const std::string& file : files) EXPECT_TRUE(file == files[0]);
    }
}

TEST(VdbVolumeBytes, TheUuidIsMadeOfTheContentHash) {
    const TemporaryFolder folder;
    ASSERT_TRUE(write_sample(vdb_sample({4, 4, 4}, 1, PixelType::half), folder / "v.vdb").value);
    EXPECT_EQ(testing::read_bytes(folder / "v.vdb").substr(21, 36),
              "01234567-89ab-cdef-0123-456789abcdef");
}

TEST(VdbVolumeBytes, ALongerOldFileLeavesNothingBehind) {
    const TemporaryFolder folder;
    const Baked volume = vdb_sample({4, 4, 4}, 1, PixelType::half);
    ASSERT_TRUE(write_sample(volume, folder / "new.vdb").value);
    testing::write_bytes(folder / "old.vdb", std::string(1 << 20, 'x'));
    ASSERT_TRUE(write_sample(volume, folder / "old.vdb").value);
    EXPECT_TRUE(testing::read_bytes(folder / "old.vdb") == testing::read_bytes(folder / "new.vdb"));
}

TEST(VdbVolumeHalf, IsRoundedToNearestEven) {
    // Every half and half of a unit in its last place, a little less and a little more.
    const auto value = [](int x, int y, int z, int) {
        const float exact = std::ldexp(static_cast<float>(1024 + x), y - 20);
        const float ulp = std::ldexp(1.0F, y - 20);
        const float halfway = exact + ulp / 2;
        return z == 0   ? std::nextafter(halfway, 0.0F)
               : z == 1 ? halfway
                        : std::nextafter(halfway, INFINITY);
    };
    Baked volume = vdb_sample({64, 12, 3}, 1, PixelType::half);
    volume.levels[0].voxels = std::make_shared<testing::FunctionVoxels>(value);
    const TemporaryFolder folder;
    ASSERT_TRUE(write_sample(volume, folder / "v.vdb").value);
    const std::vector<float> read = texels_of(config::FileFormat::vdb, volume, 0, folder / "v.vdb");
    ASSERT_EQ(read.size(), 64U * 12 * 3);
    auto stored = read.begin();
    testing::for_each_voxel({64, 12, 3}, [&](int x, int y, int z) {
        const int even = x % 2 == 0 ? x : x + 1;
        const int wanted = z == 0 ? x : z == 1 ? even : x + 1;
        EXPECT_EQ(*stored++, std::ldexp(static_cast<float>(1024 + wanted), y - 20));
    });
}

TEST(VdbVolumeLevels, LieInTheSameBoxAsTheVolume) {
    Baked volume = vdb_sample({16, 16, 1}, 1, PixelType::float32);
    volume.levels.push_back(volume.levels[0]);
    volume.levels[1].size = {8, 8, 1};
    const TemporaryFolder folder;
    testing::write_bytes(folder / "v.vdb", "");
    ASSERT_TRUE(write_vdb(volume, 1, {}, 1, nullptr, folder / "v.vdb").value);
    const auto file = test::without_errors(read_vdb(folder / "v.vdb"));
    EXPECT_EQ(file.grids[0].voxel_size, (std::array{50.0, 50.0, 25.0}));
    EXPECT_EQ(file.grids[0].first_centre, (std::array{-75.0, 25.25, 10012.5}));
}

TEST(VdbVolumeInfo, SaysWhatTheFileHolds) {
    const TemporaryFolder folder;
    const Baked volume = vdb_sample({9, 8, 7}, 4, PixelType::half, VdbCompression::zip);
    ASSERT_TRUE(write_sample(volume, folder / "v.vdb").value);
    const auto file = test::without_errors(read_vdb(folder / "v.vdb"));
    EXPECT_EQ(file.uuid, "01234567-89ab-cdef-0123-456789abcdef");
    EXPECT_EQ(file.attributes,
              (Attributes{{"skybake/kind", "noise_volume"}, {"skybake/release", "1"}}));
    ASSERT_EQ(file.grids.size(), 4U);
    for (std::size_t i = 0; i < 4; ++i) {
        const VdbGrid& grid = file.grids[i];
        EXPECT_EQ(grid.name, volume.channel_names[i]);
        EXPECT_EQ(grid.type, "Tree_float_5_4_3");
        EXPECT_EQ(grid.grid_class, "fog volume");
        EXPECT_EQ(grid.compression, "zip + active values");
        EXPECT_EQ(grid.voxel_size, (std::array{25.0, 25.0, 25.0}));
        EXPECT_EQ(grid.first_centre, (std::array{-87.5, 12.75, 10012.5}));
        EXPECT_EQ(grid.last_active, (std::array<std::int64_t, 3>{8, 7, 6}));
        EXPECT_EQ(grid.active_voxels, 9 * 8 * 7);
        EXPECT_TRUE(grid.half);
    }
}

}  // namespace
}  // namespace skybake
