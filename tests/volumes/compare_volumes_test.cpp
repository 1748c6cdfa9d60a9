// Differences between grids of any program, by value.
#include "bakers/io/manifest/compare.h"

#include <gtest/gtest.h>
#define NANOVDB_USE_OPENVDB
#include <nanovdb/util/IO.h>
#include <nanovdb/util/OpenToNanoVDB.h>

#include "tests/volumes/vdb_files.h"

namespace skybake {
namespace {

class CompareVolumes : public ::testing::Test {
  protected:
    CompareVolumes() { write_grid(any_grid(), folder_ / "a.vdb"); }
    ImageDifference of(const openvdb::GridBase::Ptr& other, std::uint32_t compression = 0) const {
        write_grid(other, folder_ / "b.vdb", compression);
        return between("a.vdb", "b.vdb");
    }
    ImageDifference between(const char* first, const char* second) const {
        const auto found = compare_volumes(folder_ / first, folder_ / second);
        for (const auto& diagnostic : found.diagnostics) ADD_FAILURE() << diagnostic.message;
        return found.value.value_or(ImageDifference{"no value", {}, {}});
    }
    TemporaryFolder folder_;
};

TEST_F(CompareVolumes, BytesMayDifferWhereValuesDoNot) {
    const ImageDifference difference = of(any_grid());
    EXPECT_TRUE(equal_within(difference, 0)) << difference.layout;
    ASSERT_EQ(difference.attributes.size(), 1U);
    EXPECT_EQ(difference.attributes[0].name, "density compression");
    nanovdb::io::writeGrid((folder_ / "c.nvdb").string(), nanovdb::openToNanoVDB(*any_grid()));
    EXPECT_TRUE(equal_within(between("a.vdb", "c.nvdb"), 0));
    EXPECT_TRUE(equal_within(between("c.nvdb", "a.vdb"), 0));
}

TEST_F(CompareVolumes, FindTheVoxelThatDiffersMost) {
    const FloatGrid::Ptr other = any_grid();
    const float before = other->tree().getValue(Coord(3, 4, 5));
    other->tree().setValue(Coord(3, 4, 5), before - 2);
    other->tree().setValue(Coord(90, -30, 200), 0.5F);  // beyond the box of the first
    const ImageDifference difference = of(other);
    ASSERT_EQ(difference.channels.size(), 1U);
    const ChannelDifference& density = difference.channels[0];
    EXPECT_EQ(density.differing, 2);
    EXPECT_FLOAT_EQ(static_cast<float>(density.max_absolute), 2);
    EXPECT_EQ(density.worst, (std::vector{3, 4, 5}));
    const double voxels = (90 + 32 + 1) * (39 + 30 + 1) * (200 + 1);
    EXPECT_NEAR(density.rms, std::sqrt(4.25 / voxels), 1e-6);
    EXPECT_EQ(between("b.vdb", "a.vdb").channels.at(0).differing, 2);
    EXPECT_FALSE(equal_within(difference, 1.9));
}

// Distances are compared as they are stored, also far from the surface, and numbers that are none.
TEST_F(CompareVolumes, TakesNumbersAsTheyAre) {
    const auto level_set = [&](float inside, const char* name) {
        const FloatGrid::Ptr grid = FloatGrid::create(3);
        grid->setName("surface");
        grid->setGridClass(openvdb::GRID_LEVEL_SET);
        grid->tree().setValue(Coord(1, 2, 3), inside);
        grid->tree().setValue(Coord(9, 9, 9), NAN);
        write_grid(grid, folder_ / name);
    };
    level_set(-2.5F, "a.vdb");
    level_set(-2.5F, "b.vdb");
    EXPECT_TRUE(equal_within(between("a.vdb", "b.vdb"), 0));
    level_set(2.75F, "b.vdb");
    EXPECT_EQ(between("a.vdb", "b.vdb").channels.at(0).max_absolute, 5.25);
}

TEST_F(CompareVolumes, SaysWhatIsNotCompared) {
    const FloatGrid::Ptr moved = any_grid();
    moved->transform().postTranslate(openvdb::Vec3d(0, 0, 0.5));
    EXPECT_NE(of(moved).layout.find("grid density: voxels of 1"), std::string::npos);
    const FloatGrid::Ptr renamed = any_grid();
    renamed->setName("smoke");
    EXPECT_EQ(of(renamed).layout, "grids density against smoke");
    const FloatGrid::Ptr wide = any_grid();
    wide->tree().setValue(Coord(20000, 0, 0), 1);
    EXPECT_NE(of(wide).layout.find("20033 voxels along x"), std::string::npos) << of(wide).layout;
    const auto switches = openvdb::BoolGrid::create();
    switches->setName("on");
    openvdb::io::File((folder_ / "a.vdb").string()).write({any_grid(), switches});
    openvdb::io::File((folder_ / "b.vdb").string()).write({any_grid(), switches});
    const ImageDifference difference = between("a.vdb", "b.vdb");
    EXPECT_EQ(difference.layout, "the bytes differ, and grid on holds bool, which is not compared");
    EXPECT_EQ(difference.channels.size(), 1U);
}

TEST_F(CompareVolumes, ComparesTheComponentsOfVectors) {
    const auto velocity = openvdb::Vec3SGrid::create(openvdb::Vec3f(1));
    velocity->setName("vel");
    for (const char* name : {"a.vdb", "b.vdb"}) {
        velocity->tree().setValue(Coord(7, 8, 9), {1, name[0] == 'a' ? 2.0F : 2.5F, 3});
        openvdb::io::File((folder_ / name).string()).write({any_grid(), velocity});
    }
    const ImageDifference difference = between("a.vdb", "b.vdb");
    EXPECT_EQ(difference.layout, "");
    ASSERT_EQ(difference.channels.size(), 4U);
    EXPECT_EQ(difference.channels[2].channel, "vel.y");
    EXPECT_EQ(difference.channels[2].max_absolute, 0.5);
    EXPECT_EQ(difference.channels[2].worst, (std::vector{7, 8, 9}));
    for (const std::size_t same : {0U, 1U, 3U}) EXPECT_EQ(difference.channels[same].differing, 0);
}

}  // namespace
}  // namespace skybake
