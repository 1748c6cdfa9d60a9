#include "bakers/field/voxel_array.h"

#include <gtest/gtest.h>

#include "tests/support/volumes.h"

namespace skybake {
namespace {

using testing::FunctionVoxels;
using testing::sample_voxel;

constexpr std::array<int, 3> kSize = {13, 6, 21};  // slices of two full tiles and a rest

TEST(VoxelArray, EqualsItsSourceInAnyBox) {
    const FunctionVoxels source(sample_voxel);
    for (const int threads : {1, 2}) {
        BakeOptions options;
        options.threads = threads;
        const VoxelArray stored = read_voxels(source, kSize, 3, options, "voxels");
        for (const VoxelBox& box : {VoxelBox{{}, kSize}, VoxelBox{{12, 5, 20}, {1, 1, 1}},
                                    VoxelBox{{3, 2, 7}, {5, 4, 10}}}) {
            std::vector<std::vector<float>> wanted(3);
            std::vector<std::vector<float>> found(3);
            std::vector<float*> wanted_targets;
            std::vector<float*> found_targets;
            for (std::size_t c = 0; c < 3; ++c) {
                wanted[c].resize(static_cast<std::size_t>(box.count()));
                found[c].assign(static_cast<std::size_t>(box.count()) + 1, -7);
                wanted_targets.push_back(wanted[c].data());
                found_targets.push_back(found[c].data());
            }
            source.fill(box, wanted_targets);
            stored.fill(box, found_targets);
            for (std::size_t c = 0; c < 3; ++c) {
                EXPECT_EQ(found[c].back(), -7);  // nothing beyond the box
                found[c].pop_back();
                EXPECT_EQ(found[c], wanted[c]);
            }
        }
    }
}

TEST(VoxelArray, FillsOnlyWhatIsWanted) {
    const VoxelArray stored = read_voxels(FunctionVoxels(sample_voxel), kSize, 2, {}, "voxels");
    float value = 0;
    stored.fill({{4, 5, 6}, {1, 1, 1}}, {nullptr, &value});
    EXPECT_EQ(value, sample_voxel(4, 5, 6, 1));
}

TEST(VoxelArray, AsksForEachVoxelOnce) {
    std::vector<int> asked(static_cast<std::size_t>(kSize[0] * kSize[1] * kSize[2]), 0);
    BakeOptions options;
    options.threads = 1;
    read_voxels(FunctionVoxels([&](int x, int y, int z, int) {
                    ++asked[static_cast<std::size_t>((z * kSize[1] + y) * kSize[0] + x)];
                    return 0.0f;
                }),
                kSize, 1, options, "voxels");
    for (const int count : asked) EXPECT_EQ(count, 1);
}

}  // namespace
}  // namespace skybake
