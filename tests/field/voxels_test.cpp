#include <gtest/gtest.h>
#include <rapidcheck.h>

#include "bakers/field/voxel_array.h"
#include "tests/support/volumes.h"

namespace skybake {
namespace {

using testing::FunctionVoxels;
using testing::sample_voxel;

constexpr std::array<int, 3> kSize = {13, 6, 21};  // slices of two full tiles and a rest

TEST(VoxelArray, EqualsItsSourceInAnyBox) {
    const FunctionVoxels source(sample_voxel);
    for (const int threads : {1, 2}) {
        const VoxelArray stored = read_voxels(source, kSize, 3, {.threads = threads}, "voxels");
        for (const VoxelBox& box : {VoxelBox{{}, kSize}, VoxelBox{{12, 5, 20}, {1, 1, 1}},
                                    VoxelBox{{3, 2, 7}, {5, 4, 10}}}) {
            auto wanted = testing::planes_of(source, box, 3);
            std::vector<std::vector<float>> found(3);
            std::vector<float*> targets;
            for (std::size_t c = 0; c < 3; ++c) {
                wanted[c].push_back(-7);  // nothing beyond the box
                found[c].assign(wanted[c].size(), -7);
                targets.push_back(found[c].data());
            }
            stored.fill(box, targets);
            EXPECT_EQ(found, wanted);
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
    read_voxels(FunctionVoxels([&](int x, int y, int z, int) {
                    ++asked[static_cast<std::size_t>((z * kSize[1] + y) * kSize[0] + x)];
                    return 0.0f;
                }),
                kSize, 1, {.threads = 1}, "voxels");
    for (const int count : asked) EXPECT_EQ(count, 1);
}

// Whether the boxes cover the volume, each voxel once, in the order of an image of `columns`.
bool covers(const std::array<int, 3>& size, int channels, int columns) {
    const BoxSequence boxes(size, channels, columns);
    std::int64_t voxels = 0;
    std::int64_t next_row = 0;  // of the image: cell row * ny + y
    for (int i = 0; i < boxes.count(); ++i) {
        const VoxelBox box = boxes[i];
        if (box.count() < 1 || box.count() > boxes.largest_count()) return false;
        if (box.origin[0] != 0 || box.size[0] != size[0]) return false;
        if (box.origin[2] % columns != 0) return false;
        const std::int64_t group = box.origin[2] / columns;
        if (group * size[1] + box.origin[1] != next_row) return false;
        const std::int64_t groups = (box.size[2] + columns - 1) / columns;
        if (groups > 1 && box.size[1] != size[1]) return false;
        next_row += groups * box.size[1];
        const std::int64_t row = std::int64_t{size[0]} * channels * columns;
        if (box.count() * channels > std::max<std::int64_t>(BoxSequence::kFloats, row))
            return false;
        voxels += box.count();
    }
    return voxels == std::int64_t{size[0]} * size[1] * size[2] &&
           next_row == std::int64_t{(size[2] + columns - 1) / columns} * size[1];
}

TEST(VoxelBoxes, CoverEveryVolumeInTheOrderOfItsFile) {
    EXPECT_TRUE(rc::check([] {
        const std::array<int, 3> size = {*rc::gen::inRange(1, 3000), *rc::gen::inRange(1, 3000),
                                         *rc::gen::inRange(1, 300)};
        RC_ASSERT(covers(size, *rc::gen::inRange(1, 5), *rc::gen::inRange(1, 40)));
    }));
}

TEST(VoxelBoxes, HardSizes) {
    for (const int channels : {1, 3, 4}) {
        EXPECT_TRUE(covers({1, 1, 1}, channels, 1));
        EXPECT_TRUE(covers({1024, 1024, 1024}, channels, 1));
        EXPECT_TRUE(covers({1024, 1024, 1024}, channels, 32));
        EXPECT_TRUE(covers({16384, 16384, 3}, channels, 1));
        EXPECT_TRUE(covers({16384, 2, 16384}, channels, 128));
        EXPECT_TRUE(covers({7, 5, 3}, channels, 11));
    }
}

TEST(VoxelBoxes, AreEnoughForThreadsToShare) {
    EXPECT_GE(BoxSequence({128, 128, 128}, 4).count(), 8);
    EXPECT_GE(box_slots(2), 3);
    EXPECT_LE(box_slots(1024) * BoxSequence::kFloats * 6, std::int64_t{640} << 20);
}

}  // namespace
}  // namespace skybake
