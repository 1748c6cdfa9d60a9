// Grids that OpenVDB's own writer has written, against OpenVDB's accessors.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/volumes/vdb_files.h"

namespace skybake {
namespace {

using testing::expect_same_voxels;
using testing::opened;

namespace io = openvdb::io;

VoxelBox box_of(const FileVoxels& file) { return {file.first, file.size}; }

std::string problem_of(const openvdb::GridBase::Ptr& grid, const std::string& name = "density") {
    const TemporaryFolder folder;
    write_grid(grid, folder / "v.vdb");
    const auto voxels = open_vdb_grid(folder / "v.vdb", name, VolumePart::voxels);
    EXPECT_TRUE(voxels.value || voxels.diagnostics.at(0).code == "E0304");
    return testing::reason_of(voxels);
}

TEST(VdbGrid, HasTheVoxelsOfOpenVdbInEveryCompression) {
    for (const float background : {0.0F, 0.125F, -1.0F}) {
        const FloatGrid::Ptr grid = any_grid(background);
        for (const std::uint32_t compression :
             {std::uint32_t{io::COMPRESS_NONE}, std::uint32_t{io::COMPRESS_ZIP},
              std::uint32_t{io::COMPRESS_ACTIVE_MASK},
              io::COMPRESS_ZIP | std::uint32_t{io::COMPRESS_ACTIVE_MASK},
              io::COMPRESS_BLOSC | std::uint32_t{io::COMPRESS_ACTIVE_MASK}}) {
            const FileVoxels file = testing::written(grid, compression);
            EXPECT_EQ(file.background, background);
            expect_same_voxels(*grid, file, box_of(file));
            expect_same_voxels(*grid, file, {{-40, -30, -9}, {90, 80, 60}});  // beyond as well
            expect_same_voxels(*grid, file, {{-3, 2, 5}, {4, 1, 11}});
        }
    }
}

TEST(VdbGrid, IsTheBoxOfActiveVoxelsAndTiles) {
    const FloatGrid::Ptr grid = any_grid();
    const FileVoxels file = testing::written(grid);
    testing::expect_active_box(*grid, file);
    float largest = 0;
    for (auto voxel = grid->cbeginValueAll(); voxel; ++voxel) {
        largest = std::max(largest, voxel.getValue());
    }
    EXPECT_EQ(file.largest, largest);
}

TEST(VdbGrid, HasTilesOfEverySize) {
    const FloatGrid::Ptr grid = testing::tiles_of_every_size();
    const FileVoxels file = testing::written(grid);
    EXPECT_EQ(file.size, (std::array<int, 3>{4096 + 256, 4096, 4096}));
    for (const int x : {-4097, -4096, -1, 0, 7, 8, 127, 128, 255, 256}) {
        expect_same_voxels(*grid, file, {{x, 0, 0}, {1, 9, 9}});
        expect_same_voxels(*grid, file, {{x, 120, 127}, {1, 9, 2}});
    }
}

TEST(VdbGrid, IsEmptyOnlyWhereNothingIs) {
    const FloatGrid::Ptr grid = any_grid();
    const FileVoxels file = testing::written(grid);
    int empty = 0;
    for (int x = -40; x < 40; x += 5) {
        for (int z = -9; z < 40; z += 7) {
            const VoxelBox box{{x, -8, z}, {5, 9, 7}};
            if (!file.voxels->is_empty(box)) continue;
            ++empty;
            std::vector<float> values(static_cast<std::size_t>(box.count()), 1.0F);
            file.voxels->fill(box, {values.data()});
            EXPECT_EQ(values, std::vector<float>(values.size(), 0.0F));
        }
    }
    EXPECT_GT(empty, 0);
}

TEST(VdbGrid, ReadsHalves) {
    const TemporaryFolder folder;
    const FloatGrid::Ptr grid = any_grid();
    grid->setSaveFloatAsHalf(true);
    write_grid(grid, folder / "v.vdb");
    const FileVoxels file = opened(folder / "v.vdb");
    constexpr float half_of_a_step = 1.0F / 4096;  // of halves below 1
    expect_same_voxels(*grid, file, box_of(file), half_of_a_step);
    io::File again((folder / "v.vdb").string());
    again.open();
    expect_same_voxels(*openvdb::gridPtrCast<FloatGrid>(again.readGrid("density")), file,
                       box_of(file));
}

TEST(VdbGrid, TakesTheTransform) {
    const FileVoxels file = testing::written(testing::scaled_and_moved_grid());
    EXPECT_EQ(file.voxel_size, (std::array<double, 3>{2, 3, 4}));
    EXPECT_EQ(file.index_origin, (std::array<double, 3>{9, 18.5, 28}));
}

TEST(VdbGridRefused, InWordsThatSayWhatItIs) {
    openvdb::initialize();
    EXPECT_EQ(problem_of(any_grid(), "Density"),
              "it has no grid `Density`; write grid = \"density\"");
    const auto vectors = openvdb::Vec3SGrid::create();
    vectors->setName("density");
    EXPECT_EQ(problem_of(vectors),
              "its grid `density` holds vectors; write grid = \"density.x\", \"density.y\" or "
              "\"density.z\"");
    const auto switches = openvdb::BoolGrid::create();
    switches->setName("density");
    EXPECT_EQ(
        problem_of(switches),
        "its grid `density` holds bool, and only grids of float, double, int32 and int64 are "
        "read");
    const FloatGrid::Ptr empty = FloatGrid::create(0);
    empty->setName("density");
    EXPECT_EQ(problem_of(empty), "it has no active voxels");
}

TEST(VdbGridRefused, WhereItsTransformIsNoBoxAlongTheAxes) {
    const auto with = [](auto&& change) { return problem_of(testing::transformed_grid(change)); };
    EXPECT_EQ(with([](auto&) {}), "");
    EXPECT_EQ(with([](auto& t) { t.postRotate(0.1, openvdb::math::Z_AXIS); }),
              "its transform turns the axes by other than right angles, or shears them");
    EXPECT_EQ(with([](auto& t) { t.postShear(0.1, openvdb::math::X_AXIS, openvdb::math::Y_AXIS); }),
              "its transform turns the axes by other than right angles, or shears them");
}

TEST(VdbGridRefused, WhereAValueIsNotFinite) {
    for (const float value :
         {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
        const FloatGrid::Ptr voxel = any_grid();
        voxel->tree().setValue(Coord(3, 4, 5), value);
        EXPECT_TRUE(problem_of(voxel).starts_with(
            "its voxel (3, 4, 5) is " + std::string(std::isnan(value) ? "nan; " : "inf; ")));
        const FloatGrid::Ptr tile = any_grid();
        tile->tree().addTile(2, Coord(1024, 0, 0), value, true);
        EXPECT_TRUE(problem_of(tile).starts_with("its voxel (1024, 0, 0) is "));
        EXPECT_EQ(problem_of(any_grid(value)), "its background is not finite");
    }
}

}  // namespace
}  // namespace skybake
