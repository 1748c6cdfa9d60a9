// Level sets as fog: OpenVDB's own conversion, and the volume of a ball.
#include <gtest/gtest.h>
#include <openvdb/tools/LevelSetSphere.h>
#include <openvdb/tools/LevelSetUtil.h>

#include <cmath>
#include <numbers>
#include <numeric>

#include "bakers/io/volumes/volume_reader.h"
#include "tests/support/refused.h"
#include "tests/support/volumes.h"
#include "tests/volumes/vdb_files.h"

namespace skybake {
namespace {

using testing::expect_same_voxels;
using testing::opened;

constexpr float half_width = 3;  // of the band, in voxels
// OpenVDB multiplies by the rounded inverse of the half width.
constexpr float rounding = 0x1p-23F;

FloatGrid::Ptr ball(float radius, float voxel, float width = half_width) {
    openvdb::initialize();
    const FloatGrid::Ptr grid = openvdb::tools::createLevelSetSphere<FloatGrid>(
        radius, {3.1F * voxel, -7.3F * voxel, 0.4F * voxel}, voxel, width);
    grid->setName("density");
    return grid;
}

// Returns the fog that OpenVDB makes of a level set.
FloatGrid::Ptr fog_of(const FloatGrid& grid) {
    const FloatGrid::Ptr fog = grid.deepCopy();
    openvdb::tools::sdfToFogVolume(*fog);
    return fog;
}

double sum_of(const FileVoxels& file) {
    const auto planes = testing::planes_of(*file.voxels, {file.first, file.size}, 1);
    return std::accumulate(planes[0].begin(), planes[0].end(), 0.0);
}

// The mean of the volumes of the balls whose radii are shorter by 0 to `width`.
double fog_of_ball(double radius, double width) {
    return std::numbers::pi / (3 * width) *
           (std::pow(radius, 4) - std::pow(std::max(radius - width, 0.0), 4));
}

TEST(LevelSet, IsTheFogOfOpenVdb) {
    for (const float voxel : {0.25F, 1.0F, 10.0F}) {
        for (const float width : {2.0F, half_width, 5.5F}) {
            const FloatGrid::Ptr grid = ball(20 * voxel, voxel, width);
            const FileVoxels file = testing::written(grid);
            EXPECT_EQ(file.background, 0);
            EXPECT_EQ(file.largest, 1);
            expect_same_voxels(*fog_of(*grid), file, {{-30, -40, -30}, {70, 70, 60}}, rounding);
        }
    }
}

// A ball that is large enough for tiles of its inside on several levels.
TEST(LevelSet, HasTilesInside) {
    const FloatGrid::Ptr grid = ball(150, 1);
    const FileVoxels file = testing::written(grid);
    const FloatGrid::Ptr fog = fog_of(*grid);
    for (const int x : {-150, -147, -80, 0, 64, 128, 150}) {
        expect_same_voxels(*fog, file, {{x, -160, -150}, {2, 320, 20}}, rounding);
        expect_same_voxels(*fog, file, {{x, -10, -150}, {2, 9, 310}}, rounding);
    }
    EXPECT_FALSE(file.voxels->is_empty({{0, 0, 0}, {8, 8, 8}}));
    EXPECT_TRUE(file.voxels->is_empty({{-159, -160, -160}, {8, 8, 8}}));
}

TEST(LevelSet, HasTheVolumeOfTheBall) {
    for (const double radius : {6.0, 12.0, 24.0, 48.0}) {
        const double found = sum_of(testing::written(ball(static_cast<float>(radius), 1)));
        const double wanted = fog_of_ball(radius, half_width);
        std::printf("radius %.0f voxels: volume off by %.2g\n", radius, found / wanted - 1);
        EXPECT_NEAR(found / wanted, 1, 0.02 / radius);
    }
}

// A ball whose middle is nearer to its surface than the half width of the band has no tile inside.
TEST(LevelSet, KeepsItsRampWhereItIsThin) {
    constexpr double radius = 3.7;
    constexpr double width = 6;
    const FileVoxels file =
        testing::written(ball(static_cast<float>(radius), 1, static_cast<float>(width)));
    EXPECT_NEAR(sum_of(file) / fog_of_ball(radius, width), 1, 0.02);
    EXPECT_LT(file.largest, radius / width);
    EXPECT_GT(file.largest, (radius - std::sqrt(3.0) / 2) / width);
}

// The band may be narrower inside than outside: the inside is what counts.
TEST(LevelSet, TakesTheHalfWidthInside) {
    const FloatGrid::Ptr grid = ball(20, 1);
    for (auto value = grid->beginValueAll(); value; ++value) {
        value.setValue(std::max(value.getValue(), -2.0F));
    }
    const FileVoxels file = testing::written(grid);
    expect_same_voxels(*fog_of(*grid), file, {file.first, file.size}, rounding);
    EXPECT_NEAR(sum_of(file) / fog_of_ball(20, 2), 1, 0.001);
}

TEST(LevelSet, IsReadFromHalves) {
    const FloatGrid::Ptr grid = ball(200, 10);
    grid->setSaveFloatAsHalf(true);
    const FileVoxels file = testing::written(grid);
    constexpr float step = 1.0F / 1024;  // of halves, relative to the half width of 30
    expect_same_voxels(*fog_of(*grid), file, {file.first, file.size}, step);
}

// Distances are in the file's unit, and the recipe may say that a voxel is larger.
TEST(LevelSet, HasTheSameDensitiesInOtherUnits) {
    const TemporaryFolder folder;
    const FloatGrid::Ptr grid = ball(2, 0.1F);
    write_grid(grid, folder / "v.vdb");
    config::VolumeFile volume;
    volume.path = folder / "v.vdb";
    for (auto& edge : volume.voxel_size) edge = config::Length{25};
    const auto source = open_volume(volume);
    ASSERT_TRUE(source.value);
    EXPECT_EQ(source.value->voxel_size_m, (std::array<double, 3>{25, 25, 25}));
    const FileVoxels file = opened(folder / "v.vdb");
    EXPECT_EQ(testing::planes_of(*source.value->voxels, {{}, source.value->size}, 1),
              testing::planes_of(*file.voxels, {file.first, file.size}, 1));
}

TEST(LevelSet, IsRefusedWithoutAHalfWidth) {
    const TemporaryFolder folder;
    for (const float background : {0.0F, -0.0F}) {
        const FloatGrid::Ptr grid = testing::any_grid(background);
        for (auto value = grid->beginValueAll(); value; ++value) {
            value.setValue(std::abs(value.getValue()));
        }
        grid->setGridClass(openvdb::GRID_LEVEL_SET);
        write_grid(grid, folder / "v.vdb");
        const config::Diagnostic said = test::expect_refused(
            open_vdb_grid(folder / "v.vdb", "density", VolumePart::shape), "E0304");
        EXPECT_TRUE(said.message.ends_with("its level set has no half width"));
    }
}

TEST(LevelSet, IsRefusedWhereADistanceIsNotFinite) {
    const TemporaryFolder folder;
    const FloatGrid::Ptr grid = ball(20, 1);
    grid->tree().setValue(Coord(3, -7, 18), std::numeric_limits<float>::quiet_NaN());
    write_grid(grid, folder / "v.vdb");
    const config::Diagnostic said = test::expect_refused(
        open_vdb_grid(folder / "v.vdb", "density", VolumePart::voxels), "E0304");
    EXPECT_NE(said.message.find("its voxel (3, -7, 18) is nan; "), std::string::npos);
}

}  // namespace
}  // namespace skybake
