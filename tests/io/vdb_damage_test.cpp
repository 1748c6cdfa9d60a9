// Tests faults: full disks, interruptions, values and files that are not what they should be.
#include <gtest/gtest.h>
#include <openvdb/io/File.h>
#include <openvdb/openvdb.h>

#include <atomic>

#include "tests/io/format_checks.h"
#include "tests/io/small_disks.h"
#include "tests/io/vdb_samples.h"
#include "tests/support/cancelled_at.h"

namespace skybake {
namespace {

using namespace testing;

TEST(VdbWriteFails, WhereTheDiskIsFull) {
    const auto written = write_sample(vdb_sample({64, 64, 64}, 1, PixelType::half), "/dev/full");
    EXPECT_FALSE(written.value.has_value());
    ASSERT_EQ(first_code(written.diagnostics), "E0301");
    EXPECT_NE(written.diagnostics[0].message.find("No space left on device"), std::string::npos)
        << written.diagnostics[0].message;
}

TEST(VdbWriteFails, InTheMiddleOfAFile) {
    const TemporaryFolder folder;
    const Baked volume = vdb_sample({128, 128, 128}, 2, PixelType::half);
    // In the tree of the first grid, in its voxels, in the second grid.
    for (const rlim_t bytes : {100000U, 3000000U, 5000000U}) {
        const LargestFile limit(bytes);
        const auto written = write_sample(volume, folder / "v.vdb");
        EXPECT_FALSE(written.value.has_value());
        ASSERT_EQ(first_code(written.diagnostics), "E0301");
        EXPECT_NE(written.diagnostics[0].message.find("File too large"), std::string::npos);
    }
}

TEST(VdbWriteFails, WhereTheFileCannotBeMade) {
    const TemporaryFolder folder;
    const Baked volume = vdb_sample({4, 4, 4}, 1, PixelType::half);
    EXPECT_EQ(first_code(write_sample(volume, folder / "none/v.vdb").diagnostics), "E0301");
    EXPECT_EQ(first_code(write_sample(volume, folder.path()).diagnostics), "E0301");
}

TEST(VdbWriteFails, ForVolumesThatContradictThemselves) {
    const TemporaryFolder folder;
    const auto code = [&](auto&& change) {
        Baked volume = vdb_sample({4, 4, 4}, 1, PixelType::half);
        change(volume);
        return first_code(write_sample(volume, folder / "v.vdb").diagnostics);
    };
    EXPECT_EQ(code([](Baked&) {}), "");
    EXPECT_EQ(code([](Baked& v) { v.levels.clear(); }), "E0500");
    EXPECT_EQ(code([](Baked& v) { v.levels[0].size[1] = 0; }), "E0500");
    EXPECT_EQ(code([](Baked& v) { v.levels[0].content_hash = "none"; }), "E0500");
    EXPECT_EQ(code([](Baked& v) { v.pixel_type = PixelType::unorm8; }), "E0500");
    EXPECT_EQ(code([](Baked& v) { v.voxel_size_m[1] = 0; }), "E0500");
    EXPECT_EQ(code([](Baked& v) { v.channel_names.clear(); }), "E0500");
}

TEST(VdbWriteFails, WhereVoxelsThrow) {
    const TemporaryFolder folder;
    Baked volume = vdb_sample({64, 64, 64}, 1, PixelType::half);
    volume.levels[0].voxels = std::make_shared<testing::FunctionVoxels>(
        [](int, int, int, int) -> float { throw std::bad_alloc(); });
    EXPECT_EQ(first_code(write_sample(volume, folder / "v.vdb").diagnostics), "E0301");
}

TEST(VdbWriteInterrupted, ReturnsEarlyWithoutAnError) {
    const TemporaryFolder folder;
    std::atomic<int> asked = 0;
    Baked volume = vdb_sample({128, 128, 2048}, 1, PixelType::half);
    volume.levels[0].voxels =
        std::make_shared<testing::FunctionVoxels>([&asked](int x, int y, int z, int) {
            if (x % 128 == 0 && y % 32 == 0 && z % 128 == 0) ++asked;
            return 0.5F;
        });
    testing::CancelledAt progress("write", 10);
    testing::write_bytes(folder / "v.vdb", "");
    const auto written = write_vdb(volume, 0, {}, 2, &progress, folder / "v.vdb");
    ASSERT_TRUE(written.value.has_value());
    EXPECT_FALSE(*written.value);
    EXPECT_GT(asked, 0);
    EXPECT_LT(asked, 32) << "of 64 parts";
}

// --- Reading ------------------------------------------------------------------------------------

TEST(VdbReadFails, WhereThereIsNoFile) {
    const TemporaryFolder folder;
    EXPECT_EQ(first_code(read_vdb(folder / "none.vdb").diagnostics), "E0300");
    EXPECT_EQ(read_code(config::FileFormat::vdb, folder / "none.vdb", {}), "E0300");
    EXPECT_EQ(first_code(read_vdb(folder.path()).diagnostics), "E0300");
    EXPECT_EQ(first_code(read_vdb("/dev/null").diagnostics), "E0300");
}

TEST(VdbReadFails, ForFilesOfAnotherKind) {
    const TemporaryFolder folder;
    testing::write_bytes(folder / "empty.vdb", "");
    testing::write_bytes(folder / "text.vdb", std::string(1000, 'x'));
    EXPECT_EQ(first_code(read_vdb(folder / "empty.vdb").diagnostics), "E0304");
    EXPECT_EQ(first_code(read_vdb(folder / "text.vdb").diagnostics), "E0304");
}

// Files of others are read where their grids fill the box; values are those of OpenVDB's accessors.
TEST(VdbReadFails, ForBoxesOfOthersElsewhere) {
    openvdb::initialize();
    const TemporaryFolder folder;
    const auto code = [&](const openvdb::CoordBBox& box, float inactive) {
        const auto grid = openvdb::FloatGrid::create();
        grid->setName("density");
        grid->sparseFill(box, 0.5F);
        grid->tree().setValueOff(openvdb::Coord(3, 4, 5), inactive);
        openvdb::io::File((folder / "v.vdb").string()).write(openvdb::GridPtrVec{grid});
        const FileShape shape = {
            {box.dim()[0], box.dim()[1], box.dim()[2]}, 1, PixelType::half, {}, 1};
        const auto visit = [&](std::int64_t first, std::int64_t count, const float* values) {
            const auto at = (5 * shape.size[1] + 4) * shape.size[0] + 3 - first;
            return at < 0 || at >= count || values[at] == inactive;
        };
        const auto read = read_file_of(vdb_format(), folder / "v.vdb", shape, 0, visit);
        return read.value == true ? "read" : first_code(read.diagnostics);
    };
    using openvdb::Coord;
    EXPECT_EQ(code({Coord(0), Coord(19, 9, 9)}, 0.25F), "read");
    EXPECT_EQ(code({Coord(0), Coord(127)}, 0), "read");  // a tile before the voxel was set
    EXPECT_EQ(code({Coord(-1), Coord(9)}, 0), "E0304");
}

TEST(VdbRead, EndsWhereTheVisitorWants) {
    const TemporaryFolder folder;
    const Baked volume = vdb_sample({8, 8, 64}, 1, PixelType::half);
    ASSERT_TRUE(write_sample(volume, folder / "v.vdb").value);
    int parts = 0;
    const auto visit = [&](std::int64_t, std::int64_t, const float*) { return ++parts < 3; };
    EXPECT_EQ(read_file_of(vdb_format(), folder / "v.vdb", shape_of(volume), 0, visit).value,
              false);
    EXPECT_EQ(parts, 3);
}

}  // namespace
}  // namespace skybake
