#include "bakers/field/baked.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>

namespace skybake {
namespace {

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
