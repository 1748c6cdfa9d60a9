// Volumes that are larger than a preview holds.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <memory>
#include <numeric>
#include <vector>

#include "bakers/preview/load_assets.h"
#include "tests/io/files.h"

namespace skybake {
namespace {

using Voxel = std::array<int, 3>;

// Zeros but for these voxels.
class FewVoxels : public VoxelSource {
  public:
    explicit FewVoxels(std::map<Voxel, float> values) : values_(std::move(values)) {}

    void fill(const VoxelBox& box, const std::vector<float*>& channels) const override {
        std::fill_n(channels[0], box.count(), 0.0F);
        for (const auto& [voxel, value] : values_) {
            std::int64_t at = 0;
            bool within = true;
            for (const std::size_t axis : {2U, 1U, 0U}) {
                const int place = voxel[axis] - box.origin[axis];
                within = within && place >= 0 && place < box.size[axis];
                at = at * box.size[axis] + place;
            }
            if (within) channels[0][at] = value;
        }
    }

  private:
    const std::map<Voxel, float> values_;
};

TEST(ShownLevel, IsMeansOverCubesWhereNoLevelIsSmallEnough) {
    const testing::TemporaryFolder folder;
    Baked volume = testing::sample_volume({4, 4, 4}, 1, PixelType::half, {config::FileFormat::vdb});
    volume.sparse = true;
    volume.levels[0].size = {1024, 1024, 257};
    // The last slice has no other in its cubes.
    volume.levels[0].voxels = std::make_shared<FewVoxels>(
        std::map<Voxel, float>{{{5, 2, 2}, 1.0F}, {{4, 3, 2}, 0.5F}, {{7, 7, 256}, 0.75F}});
    testing::write_sample_volume(folder.path(), volume);
    const auto loaded = load_folder(folder.path());
    ASSERT_TRUE(loaded.value);
    const PreviewAsset& asset = loaded.value->assets.front();
    EXPECT_EQ(asset.entry.size, (std::vector<int>{512, 512, 129}));
    EXPECT_EQ(asset.entry.levels[0].size, (Voxel{512, 512, 129}));
    ASSERT_EQ(asset.voxels.size(), std::size_t{512} * 512 * 129);
    const auto at = [&](std::size_t x, std::size_t y, std::size_t z) {
        return asset.voxels[(z * 512 + y) * 512 + x];
    };
    EXPECT_EQ(at(2, 1, 1), 1.5F / 8);
    EXPECT_EQ(at(3, 3, 128), 0.75F / 4);
    EXPECT_EQ(std::accumulate(asset.voxels.begin(), asset.voxels.end(), 0.0), 1.5 / 8 + 0.75 / 4);
    EXPECT_EQ(loaded.value->notes.back(),
              "shape: 1024 x 1024 x 257 voxels are more than a preview holds; it shows means over "
              "cubes of 2 voxels along an edge");
}

// Whatever pieces the texels come in.
TEST(ShownTexels, AreMeansOverCubes) {
    constexpr Voxel kSize = {7, 6, 9};
    constexpr Voxel kCubes = {2, 2, 3};
    constexpr int kEdge = 4;
    constexpr std::int64_t kCount = 7 * 6 * 9;
    std::vector<float> texels(2 * kCount);
    std::vector<double> sums(2 * 12), counts(2 * 12);
    for (std::size_t i = 0; i < texels.size(); ++i) {
        texels[i] = static_cast<float>(i * 7919 % 1009);
        const auto n = static_cast<int>(i / 2);
        const Voxel voxel = {n % kSize[0], n / kSize[0] % kSize[1], n / kSize[0] / kSize[1]};
        const int row = voxel[2] / kEdge * kCubes[1] + voxel[1] / kEdge;
        const auto cube = static_cast<std::size_t>(row * kCubes[0] + voxel[0] / kEdge);
        sums[2 * cube + i % 2] += texels[i];
        counts[2 * cube + i % 2] += 1;
    }
    for (const std::int64_t piece : {1, 5, 42, 378}) {
        ShownTexels shown(kSize, 2, kEdge);
        for (std::int64_t first = 0; first < kCount; first += piece) {
            shown.add(first, std::min(piece, kCount - first),
                      &texels[2 * static_cast<std::size_t>(first)]);
        }
        ASSERT_EQ(shown.values.size(), sums.size());
        for (std::size_t i = 0; i < sums.size(); ++i) {
            EXPECT_NEAR(shown.values[i], sums[i] / counts[i], 0.001);
        }
    }
}

}  // namespace
}  // namespace skybake
