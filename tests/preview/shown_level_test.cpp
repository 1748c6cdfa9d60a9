// Volumes that are larger than a preview holds.
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <numeric>
#include <vector>

#include "bakers/preview/load_assets.h"
#include "tests/io/files.h"
#include "tests/support/volumes.h"

namespace skybake {
namespace {

using Size = std::array<int, 3>;

// Zeros but for a voxel, and one of the last slice, which is alone in its cubes.
float few_voxels(int x, int y, int z, int) {
    if (x == 5 && y == 2 && z == 2) return 1;
    return x == 7 && y == 7 && z == 256 ? 0.75F : 0;
}

// They are near the origin, and only there is a file asked for them.
class FewVoxels : public testing::FunctionVoxels {
  public:
    FewVoxels() : FunctionVoxels(few_voxels) {}
    bool is_empty(const VoxelBox& box) const override { return box.origin[0] + box.origin[1] > 0; }
};

TEST(ShownLevel, IsMeansOverCubesWhereNoLevelIsSmallEnough) {
    const testing::TemporaryFolder folder;
    Baked volume = testing::sample_volume({4, 4, 4}, 1, PixelType::half, {config::FileFormat::vdb});
    volume.sparse = true;
    volume.levels[0].size = {1024, 1024, 257};
    volume.levels[0].voxels = std::make_shared<FewVoxels>();
    testing::write_sample_volume(folder.path(), volume);
    const auto loaded = load_folder(folder.path());
    ASSERT_TRUE(loaded.value);
    const auto& [entry, table, voxels] = loaded.value->assets.front();
    EXPECT_EQ(entry.size, (std::vector<int>{512, 512, 129}));
    EXPECT_EQ(entry.levels[0].size, (Size{512, 512, 129}));
    ASSERT_EQ(voxels.size(), std::size_t{512} * 512 * 129);
    EXPECT_EQ(voxels[(1 * 512 + 1) * 512 + 2], 1.0F / 8);
    EXPECT_EQ(voxels[(128 * 512 + 3) * 512 + 3], 0.75F / 4);
    EXPECT_EQ(std::accumulate(voxels.begin(), voxels.end(), 0.0), 1.0 / 8 + 0.75 / 4);
    EXPECT_EQ(loaded.value->notes.back(),
              "shape: 1024 x 1024 x 257 voxels are more than a preview holds; it shows means over "
              "cubes of 2 voxels along an edge");
}

// The mean of what is linear in x, y and z is its value in the middle, whatever pieces the texels come in.
TEST(ShownTexels, AreMeansOverCubes) {
    constexpr Size kSize = {7, 6, 9};
    std::vector<float> texels;
    for (int i = 0; i < 7 * 6 * 9; ++i) {
        texels.push_back(static_cast<float>(i % 7 + 10 * (i / 7 % 6) + 100 * (i / 42)));
        texels.push_back(-texels.back());
    }
    for (const std::int64_t piece : {1, 5, 42, 378}) {
        ShownTexels shown(kSize, 2, 4);
        for (std::int64_t first = 0; first < 378; first += piece) {
            shown.add(first, std::min(piece, 378 - first), texels.data() + 2 * first);
        }
        ASSERT_EQ(shown.values.size(), 24U);
        for (std::size_t i = 0; i < 12; ++i) {
            const auto middle = [](std::size_t cube, std::size_t size) {
                return static_cast<double>(4 * cube + std::min(4 * cube + 3, size - 1)) / 2;
            };
            const double mean =
                middle(i % 2, 7) + 10 * middle(i / 2 % 2, 6) + 100 * middle(i / 4, 9);
            EXPECT_NEAR(shown.values[2 * i], mean, 1e-3);
            EXPECT_NEAR(shown.values[2 * i + 1], -mean, 1e-3);
        }
    }
}

}  // namespace
}  // namespace skybake
