#include "bakers/field/held_voxels.h"

#include <gtest/gtest.h>

#include <atomic>

#include "tests/support/volumes.h"

namespace skybake {
namespace {

using testing::FunctionVoxels;
using testing::sample_voxel;

constexpr std::array<int, 3> kSize = {700, 300, 5};  // slices of two boxes, the second smaller
constexpr int kChannels = 2;
constexpr std::int64_t kBytes = std::int64_t{700} * 300 * 5 * kChannels * 4;

BakeOptions options_with(std::int64_t held_voxel_bytes) {
    BakeOptions options;
    options.threads = 2;
    options.held_voxel_bytes = held_voxel_bytes;
    return options;
}

// Counts how often voxels are made. The lower half is known to be empty.
class CountedVoxels : public VoxelSource {
  public:
    void fill(const VoxelBox& box, const std::vector<float*>& channels) const override {
        made += box.count();
        FunctionVoxels(sample_voxel).fill(box, channels);
    }
    bool is_empty(const VoxelBox& box) const override {
        return box.origin[2] + box.size[2] <= kSize[2] / 2;
    }
    mutable std::atomic<std::int64_t> made = 0;
};

TEST(HeldVoxels, AreMadeOnceAndReadInAnyBox) {
    const auto source = std::make_shared<CountedVoxels>();
    const auto held = held_voxels(source, kSize, kChannels, options_with(kBytes));
    ASSERT_NE(held, source);
    for (int pass = 0; pass < 2; ++pass) {
        for (const VoxelBox& box :
             {VoxelBox{{}, kSize}, VoxelBox{{699, 299, 4}, {1, 1, 1}},
              VoxelBox{{3, 2, 1}, {600, 290, 3}}, VoxelBox{{0, 180, 2}, {700, 60, 2}}}) {
            std::vector<float> wanted(static_cast<std::size_t>(box.count()));
            std::vector<float> found(wanted.size());
            FunctionVoxels(sample_voxel).fill(box, {nullptr, wanted.data()});
            held->fill(box, {nullptr, found.data()});
            EXPECT_EQ(found, wanted);
        }
    }
    EXPECT_EQ(source->made, (VoxelBox{{}, kSize}.count()));
}

TEST(HeldVoxels, KnowWhichBoxesAreEmpty) {
    const auto held =
        held_voxels(std::make_shared<CountedVoxels>(), kSize, kChannels, options_with(kBytes));
    EXPECT_TRUE(held->is_empty({{}, {700, 300, 2}}));
    EXPECT_FALSE(held->is_empty({{}, {700, 300, 3}}));
}

TEST(HeldVoxels, AreMadeOnDemandWhereTheyDoNotFit) {
    const auto source = std::make_shared<CountedVoxels>();
    EXPECT_EQ(held_voxels(source, kSize, kChannels, options_with(kBytes - 1)), source);
    EXPECT_EQ(source->made, 0);
    EXPECT_EQ(VoxelMemory::total(), 0);
}

TEST(HeldVoxels, CountTogetherUntilTheyAreReleased) {
    const BakeOptions options = options_with(2 * kBytes - 1);
    const auto source = std::make_shared<CountedVoxels>();
    auto first = held_voxels(source, kSize, kChannels, options);
    EXPECT_NE(first, source);
    EXPECT_EQ(VoxelMemory::total(), kBytes);
    EXPECT_EQ(held_voxels(source, kSize, kChannels, options), source);
    first.reset();
    EXPECT_EQ(VoxelMemory::total(), 0);
    EXPECT_NE(held_voxels(source, kSize, kChannels, options), source);
}

TEST(HeldVoxels, AreNotHeldWhereNothingMayBe) {
    const auto source = std::make_shared<CountedVoxels>();
    EXPECT_EQ(held_voxels(source, {1, 1, 1}, 1, options_with(0)), source);
}

}  // namespace
}  // namespace skybake
