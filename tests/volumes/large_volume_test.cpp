// Occupancy and distances of a sparse VDB of 1024^3 voxels, in one run of the program within 1 GiB.
// It runs alone in its process, which counts the memory of its children.
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <cstdlib>
#include <string>

#include "tests/volumes/vdb_files.h"

namespace skybake {
namespace {

constexpr int edge = 1024;

// Balls of leaves in which no two voxels are alike. Returns the share of voxels that are active.
double write_balls(const std::filesystem::path& path) {
    openvdb::initialize();
    const FloatGrid::Ptr grid = FloatGrid::create(0);
    grid->setName("density");
    grid->setGridClass(openvdb::GRID_FOG_VOLUME);
    grid->setSaveFloatAsHalf(true);
    grid->setTransform(openvdb::math::Transform::createLinearTransform(10));
    constexpr int balls = 120;
    constexpr int radius = 6;  // in leaves
    for (int ball = 0; ball < balls; ++ball) {
        const Coord middle(radius + ball * 37 % 115, radius + ball * 61 % 115,
                           radius + ball * 83 % 115);
        for (int i = 0; i < 8 * radius * radius * radius; ++i) {
            const Coord offset(i % (2 * radius) - radius, i / (2 * radius) % (2 * radius) - radius,
                               i / (4 * radius * radius) - radius);
            if (offset.asVec3i().lengthSqr() > radius * radius) continue;
            const Coord at = (middle + offset) << 3;  // leaves have 8 voxels along an edge
            auto* leaf = grid->tree().touchLeaf(at);
            leaf->setValuesOn();
            float* values = leaf->buffer().data();
            for (int v = 0; v < 512; ++v) {
                values[v] = static_cast<float>((v * 97 + ball * 31) % 512 + 1) / 512;
            }
        }
    }
    grid->tree().setValue(Coord(0), 0.5F);
    grid->tree().setValue(Coord(edge - 1), 0.5F);
    testing::write_grid(grid, path);
    return static_cast<double>(grid->activeVoxelCount()) / edge / edge / edge;
}

const char* const recipe = R"([volumes.balls]
file = "balls.vdb"

[clouds.balls]
volume = "balls"

[bake.cloud]
asset = "cloud_volume"
cloud = "balls"
size = [1024, 1024, 1024]

[bake.cells]
asset = "occupancy"
of = "cloud"
cell = 8

[bake.distance]
asset = "cloud_distance"
of = "cloud"
cell = 4
)";

TEST(LargeVolume, IsSearchedWithinAGibibyte) {
    const TemporaryFolder folder;
    const double share = write_balls(folder / "balls.vdb");
    EXPECT_GT(share, 0.04);
    testing::write_bytes(folder / "balls.toml", recipe);
    const std::string path = folder.path().string();
    const std::string command = SKYBAKE_PROGRAM " bake " + path + "/balls.toml -o " + path +
                                "/out --only cells --only distance";
    ASSERT_EQ(std::system(command.c_str()), 0);
    rusage usage{};
    ::getrusage(RUSAGE_CHILDREN, &usage);
    std::printf("%.1f %% active, peak memory %ld MiB\n", 100 * share, usage.ru_maxrss >> 10);
    EXPECT_LE(usage.ru_maxrss, 1 << 20) << "KiB";
}

}  // namespace
}  // namespace skybake
