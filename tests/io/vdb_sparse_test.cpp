// Sparse files of write_vdb against OpenVDB's own reader, and against trees that OpenVDB built and
// wrote.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <atomic>
#include <cmath>

#include "bakers/io/formats/vdb/vdb_file.h"
#include "bakers/io/formats/vdb/vdb_source.h"
#include "tests/io/files.h"
#include "tests/io/vdb_samples.h"
#include "tests/io/vdb_trees.h"
#include "tests/support/cancelled_at.h"

namespace skybake {
namespace {

using config::VdbCompression;
using openvdb::Coord;
using testing::FunctionVoxels;
using testing::wrong_with;
using Size = std::array<int, 3>;
using Function = FunctionVoxels::Function;

Baked sparse_sample(const Size& size, int channels, Function function,
                    PixelType type = PixelType::half,
                    VdbCompression compression = VdbCompression::none) {
    Baked volume = testing::vdb_sample(size, channels, type, compression);
    volume.sparse = true;
    volume.levels[0].voxels = std::make_shared<FunctionVoxels>(std::move(function));
    return volume;
}

// 0, values that are stored as 0, values that nearly are, and others.
float speckle(int x, int y, int z, int channel) {
    const float value = testing::sample_voxel(x, y, z, channel);
    // The third is a tie between 0 and the least half.
    const std::array values = {0.0F,      -0.0F,  0x1p-25F, std::nextafter(0x1p-25F, 1.0F),
                               -0x1p-26F, -value, value,    value,
                               value};
    return values[static_cast<std::size_t>(value * 1e6F) % 9];
}

// Speckles within boxes, 0 outside of them.
struct Boxes {
    std::vector<VoxelBox> boxes;
    float operator()(int x, int y, int z, int channel) const {
        for (const VoxelBox& box : boxes) {
            const auto inside = [&](int at, std::size_t axis) {
                return at >= box.origin[axis] && at < box.origin[axis] + box.size[axis];
            };
            if (inside(x, 0) && inside(y, 1) && inside(z, 2)) return speckle(x, y, z, channel);
        }
        return (x + y) % 2 == 0 ? 0.0F : -0.0F;
    }
};

Baked random_volume() {
    // One axis is so long that the tree has several nodes.
    Size size = {*rc::gen::inRange(1, 30), *rc::gen::inRange(1, 30), *rc::gen::inRange(1, 30)};
    size[*rc::gen::inRange<std::size_t>(0, 3)] = *rc::gen::inRange(1, 400);
    Boxes content;
    for (int left = *rc::gen::inRange(0, 4); left > 0; --left) {
        VoxelBox box;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            box.origin[axis] = *rc::gen::inRange(0, size[axis]);
            box.size[axis] = *rc::gen::inRange(1, 20);
        }
        content.boxes.push_back(box);
    }
    const auto compression = static_cast<VdbCompression>(*rc::gen::inRange(0, 3));
    const PixelType type = *rc::gen::element(PixelType::half, PixelType::float32);
    return sparse_sample(size, *rc::gen::inRange(1, 3), content, type, compression);
}

RC_GTEST_PROP(VdbSparse, HoldsWhatOpenVdbWouldAndGivesItBack, ()) {
    const Baked volume = random_volume();
    RC_ASSERT(wrong_with(volume) == "");
}

TEST(VdbSparseCases, TheFewestAndTheMostVoxels) {
    const auto none = [](int, int, int, int) { return -0.0F; };
    const auto all = [](int, int, int, int) { return 0.5F; };
    const auto one = [](int x, int y, int z, int) { return x == 129 && y == 7 && z == 8; };
    for (const VdbCompression compression :
         {VdbCompression::none, VdbCompression::zip, VdbCompression::blosc}) {
        for (const PixelType type : {PixelType::half, PixelType::float32}) {
            const Size size = {131, 9, 17};
            EXPECT_EQ(wrong_with(sparse_sample(size, 1, none, type, compression)), "");
            EXPECT_EQ(wrong_with(sparse_sample(size, 1, all, type, compression)), "");
            EXPECT_EQ(wrong_with(sparse_sample(size, 1, one, type, compression)), "");
        }
    }
}

TEST(VdbSparseCases, NodesOf4096Voxels) {
    const auto far = [](int x, int, int z, int) { return x == 4096 || z == 4097 ? 0.25F : 0.0F; };
    EXPECT_EQ(wrong_with(sparse_sample({4100, 3, 2}, 1, far)), "");
    EXPECT_EQ(wrong_with(sparse_sample({2, 3, 4100}, 1, far)), "");
    const auto both = [](int x, int, int, int) { return x == 0 || x == 4099 ? 0.25F : 0.0F; };
    EXPECT_EQ(wrong_with(sparse_sample({4100, 3, 2}, 1, both)), "");
}

TEST(VdbSparseCases, ChannelsHaveVoxelsOfTheirOwn) {
    // None in the first, second and last, whose grids must be there all the same.
    const auto third = [](int x, int y, int, int channel) {
        return channel == 2 && x > 100 && y < 9 ? 0.125F : 0.0F;
    };
    EXPECT_EQ(wrong_with(sparse_sample({150, 20, 9}, 4, third)), "");
    Baked named = sparse_sample({20, 20, 20}, 2, speckle);
    named.grid_names = {"density", "temperature"};
    EXPECT_EQ(wrong_with(named), "");
}

// Compares with dense volumes: the same places, the same values.
TEST(VdbSparseCases, VoxelsNeedNotBeCubes) {
    const TemporaryFolder folder;
    Baked volume = sparse_sample({20, 20, 20}, 1, speckle);
    volume.voxel_size_m = {10, 20, 40};
    ASSERT_TRUE(testing::write_sample(volume, folder / "v.vdb").value);
    openvdb::initialize();
    openvdb::io::File file((folder / "v.vdb").string());
    file.open();
    const auto grid = file.readGrid("density");
    EXPECT_EQ(grid->indexToWorld(Coord(0)), openvdb::Vec3d(-95, 10.25, 10020));
    EXPECT_EQ(grid->indexToWorld(Coord(1, 2, 3)), openvdb::Vec3d(-85, 50.25, 10140));
    const auto read = read_vdb(folder / "v.vdb");
    ASSERT_TRUE(read.value.has_value());
    EXPECT_EQ(read.value->grids[0].voxel_size, (std::array{10.0, 20.0, 40.0}));
    const auto opened = open_vdb_grid(folder / "v.vdb", "density", VolumePart::shape);
    EXPECT_EQ(opened.value.value_or(FileVoxels{}).size, (std::array{20, 20, 20}));
}

// --- How the file is made -----------------------------------------------------------------------

// Balls, most of them in a corner; knows where there are none, and counts what it is asked for.
class CountedBalls : public VoxelSource {
  public:
    void fill(const VoxelBox& box, const std::vector<float*>& channels) const override {
        ++fills;
        FunctionVoxels([](int x, int y, int z, int channel) {
            const int squared = x * x + y * y + z * z;
            return squared < 90 * 90 ? testing::sample_voxel(x, y, z, channel) : 0.0F;
        }).fill(box, channels);
    }
    bool is_empty(const VoxelBox& box) const override {
        return box.origin[0] >= 90 || box.origin[1] >= 90 || box.origin[2] >= 90;
    }
    mutable std::atomic<int> fills = 0;
};

struct Written {
    std::string bytes;
    int fills = 0;
};

Written write_balls(int threads, std::size_t most_kept_bytes) {
    const TemporaryFolder folder;
    const auto balls = std::make_shared<CountedBalls>();
    Baked volume = sparse_sample({300, 140, 120}, 2, speckle);
    volume.levels[0].voxels = balls;
    testing::write_bytes(folder / "v.vdb", "");
    EXPECT_TRUE(
        write_vdb(volume, 0, {}, threads, nullptr, folder / "v.vdb", most_kept_bytes).value);
    return {testing::read_bytes(folder / "v.vdb"), balls->fills};
}

TEST(VdbSparseBytes, DependOnNeitherThreadsNorWhatIsKept) {
    const Written first = write_balls(1, vdb_most_kept_bytes);
    // One of three nodes is not empty; three of its strips have voxels of each channel.
    EXPECT_EQ(first.fills, 2 * 3);
    for (const std::size_t kept : {std::size_t{0}, first.bytes.size() / 2, first.bytes.size()}) {
        for (const int threads : {1, 2, 7}) {
            const Written again = write_balls(threads, kept);
            EXPECT_TRUE(again.bytes == first.bytes) << threads << " threads, " << kept << " kept";
            EXPECT_GE(again.fills, first.fills);
            EXPECT_EQ(again.fills == 2 * first.fills, kept == 0);
            EXPECT_EQ(again.fills == first.fills, kept == first.bytes.size());
        }
    }
}

TEST(VdbSparseWriteFails, WhereTheDiskIsFullOrVoxelsThrow) {
    const auto full = testing::write_sample(sparse_sample({64, 64, 64}, 1, speckle), "/dev/full");
    EXPECT_EQ(testing::first_code(full.diagnostics), "E0301");
    const TemporaryFolder folder;
    const auto thrown = testing::write_sample(
        sparse_sample({64, 64, 64}, 1, [](int, int, int, int) -> float { throw std::bad_alloc(); }),
        folder / "v.vdb");
    EXPECT_EQ(testing::first_code(thrown.diagnostics), "E0301");
}

TEST(VdbSparseWriteFails, ForNamesThatAreNotOnePerGrid) {
    const TemporaryFolder folder;
    const auto code = [&](std::vector<std::string> names) {
        Baked volume = sparse_sample({4, 4, 4}, 2, speckle);
        volume.grid_names = std::move(names);
        return testing::first_code(testing::write_sample(volume, folder / "v.vdb").diagnostics);
    };
    EXPECT_EQ(code({"density", "ice"}), "");
    EXPECT_EQ(code({"density"}), "E0500");
    EXPECT_EQ(code({"density", "density"}), "E0500");
    EXPECT_EQ(code({"density", "ice", "ice"}), "E0500");
    EXPECT_EQ(code({"density", ""}), "E0500");
}

TEST(VdbSparseWriteInterrupted, WhileStripsAreSurveyedAndWhileTheyAreWritten) {
    const TemporaryFolder folder;
    testing::write_bytes(folder / "v.vdb", "");
    const Baked volume = sparse_sample({300, 140, 120}, 1, speckle);
    for (const double fraction : {0.1, 0.4, 0.6, 0.9}) {
        testing::CancelledAt progress("", 1 << 20, fraction);
        progress.in_order = true;
        const auto written = write_vdb(volume, 0, {}, 2, &progress, folder / "v.vdb", 0);
        ASSERT_TRUE(written.value.has_value());
        EXPECT_FALSE(*written.value) << fraction;
    }
    testing::CancelledAt never("", 1 << 20);
    never.in_order = true;
    EXPECT_EQ(write_vdb(volume, 0, {}, 2, &never, folder / "v.vdb", 0).value, true);
}

}  // namespace
}  // namespace skybake
