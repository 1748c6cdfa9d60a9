// NanoVDB grids as volumes, against NanoVDB's own converter, writer and accessors.
#include <gtest/gtest.h>
#include <nanovdb/util/IO.h>
#include <nanovdb/util/OpenToNanoVDB.h>
#include <openvdb/tools/LevelSetSphere.h>

#include <limits>

#include "bakers/io/formats/format.h"
#include "bakers/io/formats/nvdb/nvdb_source.h"
#include "bakers/io/volumes/volume_reader.h"
#include "tests/support/outcomes.h"
#include "tests/support/volumes.h"
#include "tests/volumes/vdb_files.h"

namespace skybake {
namespace {

using Handle = nanovdb::GridHandle<>;

template <class Build>
Handle converted(const FloatGrid& grid) {
    nanovdb::OpenToNanoVDB<float, Build> convert;
    return convert(grid, nanovdb::StatsMode::All, nanovdb::ChecksumMode::Full, 0);
}

FileVoxels opened_nvdb(const std::filesystem::path& path, const std::string& grid = "density") {
    return test::without_diagnostics(open_nvdb_grid(path, grid, VolumePart::voxels));
}

// A grid as its file has it, which is gone again.
FileVoxels written_nvdb(const Handle& handle) {
    const TemporaryFolder folder;
    nanovdb::io::writeGrid((folder / "v.nvdb").string(), handle);
    return opened_nvdb(folder / "v.nvdb");
}

template <class Build>
void expect_accessors_voxels(const Handle& handle, const FileVoxels& file, const VoxelBox& box) {
    const auto accessor = handle.grid<Build>()->getAccessor();
    testing::expect_voxels_at<nanovdb::Coord>(
        file, box, [&](const nanovdb::Coord& at) { return accessor.getValue(at); });
}

template <class Build>
void expect_grid(const FloatGrid& grid, float background) {
    const Handle handle = converted<Build>(grid);
    const FileVoxels file = written_nvdb(handle);
    EXPECT_EQ(file.background, background);
    testing::expect_active_box(grid, file);
    expect_accessors_voxels<Build>(handle, file, {file.first, file.size});
    expect_accessors_voxels<Build>(handle, file, {{-40, -30, -9}, {90, 80, 60}});
    expect_accessors_voxels<Build>(handle, file, {{-3, 2, 5}, {4, 1, 11}});
}

std::string problem_of_nvdb(const std::filesystem::path& path,
                            const std::string& grid = "density") {
    const auto voxels = open_nvdb_grid(path, grid, VolumePart::voxels);
    EXPECT_TRUE(voxels.value || voxels.diagnostics.at(0).code == "E0304");
    return testing::reason_of(voxels);
}

std::string problem_of_nvdb(const Handle& handle) {
    const TemporaryFolder folder;
    nanovdb::io::writeGrid((folder / "v.nvdb").string(), handle);
    return problem_of_nvdb(folder / "v.nvdb");
}

TEST(NvdbGrid, HasTheVoxelsOfNanoVdb) {
    for (const float background : {0.0F, 0.125F, -1.0F}) {
        const FloatGrid::Ptr grid = any_grid(background);
        expect_grid<float>(*grid, background);
        expect_grid<nanovdb::Fp8>(*grid, background);
        expect_grid<nanovdb::Fp16>(*grid, background);
    }
}

TEST(NvdbGrid, HasTilesOfEverySize) {
    const Handle handle = converted<float>(*testing::tiles_of_every_size());
    const FileVoxels file = written_nvdb(handle);
    EXPECT_EQ(file.size, (std::array<int, 3>{4096 + 256, 4096, 4096}));
    EXPECT_EQ(file.largest, 0.75F);
    for (const int x : {-4097, -4096, -1, 0, 7, 8, 127, 128, 255, 256}) {
        expect_accessors_voxels<float>(handle, file, {{x, 0, 0}, {1, 9, 9}});
        expect_accessors_voxels<float>(handle, file, {{x, 120, 127}, {1, 9, 2}});
    }
    EXPECT_TRUE(file.voxels->is_empty({{8, 0, 0}, {120, 8, 8}}));
    EXPECT_FALSE(file.voxels->is_empty({{7, 0, 0}, {1, 1, 1}}));
    EXPECT_FALSE(file.voxels->is_empty({{-4100, 0, 0}, {5, 1, 1}}));
}

TEST(NvdbGrid, TakesTheTransform) {
    const FileVoxels file = written_nvdb(converted<float>(*testing::scaled_and_moved_grid()));
    EXPECT_EQ(file.voxel_size, (std::array<double, 3>{2, 3, 4}));
    EXPECT_EQ(file.index_origin, (std::array<double, 3>{9, 18.5, 28}));
}

// Whatever wrote it, a file whose checksum does not match is damaged: a bit in each of many places of
// grid, tree, root and nodes. The rest of the last leaf's bytes are its values.
TEST(NvdbGrid, IsDamagedIfItsChecksumSaysSo) {
    const TemporaryFolder folder;
    const auto path = folder / "v.nvdb";
    for (const auto mode : {nanovdb::ChecksumMode::Full, nanovdb::ChecksumMode::Partial,
                            nanovdb::ChecksumMode::Disable}) {
        nanovdb::OpenToNanoVDB<float, float> convert;
        nanovdb::io::writeGrid(path.string(),
                               convert(*any_grid(), nanovdb::StatsMode::All, mode, 0));
        const std::string whole = testing::read_bytes(path);
        EXPECT_EQ(problem_of_nvdb(path), "");
        const std::size_t grid_at = whole.find("NanoVDB0", 8);
        ASSERT_NE(grid_at, std::string::npos);
        int noticed = 0;
        int tried = 0;
        constexpr std::size_t step = 9973;
        for (std::size_t at = grid_at + 16; at < whole.size(); at += step, ++tried) {
            std::string damaged = whole;
            damaged[at] = static_cast<char>(damaged[at] ^ 4);
            testing::write_bytes(path, damaged);
            noticed += problem_of_nvdb(path).empty() ? 0 : 1;
        }
        ASSERT_GT(tried, 30);
        if (mode == nanovdb::ChecksumMode::Full) {
            EXPECT_EQ(noticed, tried);
        } else {
            EXPECT_LT(noticed, tried) << "other programs need not sum all nodes";
        }
    }
}

// The same grid as VDB and as NanoVDB gives the same densities.
TEST(NvdbGrid, MakesFogOfALevelSetAsVdbDoes) {
    openvdb::initialize();
    const FloatGrid::Ptr ball =
        openvdb::tools::createLevelSetSphere<FloatGrid>(20, {1.5F, 2, -3}, 0.5F);
    ball->setName("density");
    const FileVoxels wanted = testing::written(ball);
    const FileVoxels file = written_nvdb(converted<float>(*ball));
    EXPECT_EQ(file.largest, 1);
    EXPECT_EQ(file.size, wanted.size);
    const VoxelBox box{{-45, -45, -50}, {90, 95, 93}};
    EXPECT_EQ(testing::planes_of(*file.voxels, box, 1), testing::planes_of(*wanted.voxels, box, 1));
}

// Files of several grids, in one segment or in one each.
TEST(NvdbGrid, IsFoundByItsName) {
    const TemporaryFolder folder;
    const FloatGrid::Ptr first = any_grid();
    const FloatGrid::Ptr second = any_grid(0.5F);
    first->setName("heat");
    std::vector<Handle> handles;
    handles.push_back(converted<float>(*first));
    handles.push_back(converted<nanovdb::Fp8>(*second));
    nanovdb::io::writeGrids((folder / "one.nvdb").string(), handles);
    nanovdb::io::writeGrid((folder / "a.nvdb").string(), handles[0]);
    nanovdb::io::writeGrid((folder / "b.nvdb").string(), handles[1]);
    testing::write_bytes(folder / "two.nvdb", testing::read_bytes(folder / "a.nvdb") +
                                                  testing::read_bytes(folder / "b.nvdb"));
    for (const char* name : {"one.nvdb", "two.nvdb"}) {
        EXPECT_EQ(opened_nvdb(folder / name, "heat").background, 0);
        EXPECT_EQ(opened_nvdb(folder / name, "density").background, 0.5F);
        EXPECT_EQ(problem_of_nvdb(folder / name, "Density"),
                  "it has no grid `Density`; write grid = \"heat\" or grid = \"density\"");
    }
}

// The files of a bake can be read as volumes.
TEST(NvdbGrid, IsWhatABakeWrites) {
    const TemporaryFolder folder;
    for (const auto type : {config::PixelType::float32, config::PixelType::half}) {
        Baked volume = testing::plain_volume({21, 17, 30}, 1, type);
        volume.voxel_size_m = {10, 20, 5};
        testing::write_bytes(folder / "v.nvdb", "");
        ASSERT_TRUE(format_of(config::FileFormat::nvdb)
                        .write({volume, 0, "{}", 1, nullptr}, folder / "v.nvdb")
                        .value);
        config::VolumeFile asked;
        asked.format = config::VolumeFormat::nvdb;
        asked.path = folder / "v.nvdb";
        const auto source = open_volume(asked);
        ASSERT_TRUE(source.value);
        EXPECT_EQ(source.value->size, volume.levels[0].size);
        EXPECT_EQ(source.value->voxel_size_m, volume.voxel_size_m);
        std::vector<float> wanted = testing::voxels_of(volume, 0);
        round_values(wanted.data(), wanted.size(), type);
        const VoxelBox box{{}, source.value->size};
        EXPECT_EQ(testing::planes_of(*source.value->voxels, box, 1)[0], wanted);
    }
}

TEST(NvdbGridRefused, InWordsThatSayWhatItIs) {
    const TemporaryFolder folder;
    openvdb::initialize();
    const auto vectors = openvdb::Vec3SGrid::create(openvdb::Vec3f(0));
    vectors->setName("density");
    vectors->tree().setValue(Coord(1, 2, 3), openvdb::Vec3f(1));
    EXPECT_TRUE(problem_of_nvdb(nanovdb::openToNanoVDB(*vectors))
                    .starts_with("its grid `density` holds vec3f; `nanovdb_convert"));
    const FloatGrid::Ptr empty = FloatGrid::create(0);
    empty->setName("density");
    EXPECT_EQ(problem_of_nvdb(converted<float>(*empty)), "it has no active voxels");
    testing::write_grid(any_grid(), folder / "v.nvdb");
    EXPECT_EQ(problem_of_nvdb(folder / "v.nvdb"),
              "it begins with neither `NanoVDB0` nor `NanoVDB2`");
    for (const float value :
         {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
        const FloatGrid::Ptr voxel = any_grid();
        voxel->tree().setValue(Coord(3, 4, 5), value);
        EXPECT_TRUE(
            problem_of_nvdb(converted<float>(*voxel)).starts_with("its voxel (3, 4, 5) is "));
        const FloatGrid::Ptr tile = any_grid();
        tile->tree().addTile(2, Coord(1024, 0, 0), value, true);
        EXPECT_EQ(problem_of_nvdb(converted<float>(*tile)), "a tile of it is not finite");
    }
}

TEST(NvdbGridRefused, WhereItsTransformIsNoBoxAlongTheAxes) {
    const auto with = [&](auto&& change) {
        return problem_of_nvdb(converted<float>(*testing::transformed_grid(change)));
    };
    EXPECT_EQ(with([](auto&) {}), "");
    EXPECT_EQ(with([](auto& t) { t.postRotate(0.1, openvdb::math::Z_AXIS); }),
              "its transform turns the axes by other than right angles, or shears them");
    EXPECT_EQ(with([](auto& t) { t.preScale(openvdb::Vec3d(1, -1, 1)); }), "");
}

// OpenVDB 12 and later write other numbers at the beginning of files and grids, and nothing else that
// floats have.
TEST(NvdbGrid, MayBeOfLaterReleases) {
    const TemporaryFolder folder;
    const Handle handle = converted<float>(*any_grid());
    nanovdb::io::writeGrid((folder / "old.nvdb").string(), handle);
    std::string bytes = testing::read_bytes(folder / "old.nvdb");
    const std::size_t grid = bytes.find("NanoVDB0", 8);
    bytes[7] = '2';
    bytes[grid + 7] = '1';
    testing::write_bytes(folder / "v.nvdb", bytes);
    const FileVoxels file = opened_nvdb(folder / "v.nvdb");
    expect_accessors_voxels<float>(handle, file, {file.first, file.size});
    bytes[14] = 2;  // the codec
    testing::write_bytes(folder / "v.nvdb", bytes);
    EXPECT_TRUE(problem_of_nvdb(folder / "v.nvdb")
                    .starts_with("it is compressed by blosc; `nanovdb_convert"));
    testing::write_bytes(folder / "v.nvdb", bytes.substr(grid));
    EXPECT_EQ(problem_of_nvdb(folder / "v.nvdb"), "it is a grid without a file's head");
}

// A file in which a node is listed twice could take memory that the file does not fill.
TEST(NvdbGridRefused, WhereANodeIsListedTwice) {
    Handle handle = converted<float>(*any_grid());
    auto* root = handle.grid<float>()->tree().root().data();
    ASSERT_GT(root->mTableSize, 1U);
    root->tile(1)->key = root->tile(0)->key;
    root->tile(1)->child = root->tile(0)->child;
    EXPECT_EQ(problem_of_nvdb(handle), "nodes are listed twice");
}

TEST(NvdbGridRefused, WhereItsBoundsLeaveOutVoxels) {
    Handle handle = converted<float>(*any_grid());
    auto* root = handle.grid<float>()->tree().root().data();
    root->mBBox.max()[0] = 3;
    EXPECT_EQ(problem_of_nvdb(handle), "it has active voxels beyond its bounds");
}

TEST(NvdbGridRefused, WhereverItEnds) {
    const TemporaryFolder folder;
    nanovdb::io::writeGrid((folder / "v.nvdb").string(), converted<float>(*any_grid()));
    const std::string bytes = testing::read_bytes(folder / "v.nvdb");
    for (std::size_t size = 0; size < bytes.size(); size += 1 + bytes.size() / 40) {
        testing::write_bytes(folder / "v.nvdb", bytes.substr(0, size));
        EXPECT_NE(problem_of_nvdb(folder / "v.nvdb"), "") << size << " of " << bytes.size();
    }
}

}  // namespace
}  // namespace skybake
