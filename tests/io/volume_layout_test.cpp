#include "bakers/io/volume_layout.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>

namespace skybake {
namespace {

using Kind = config::VolumeLayout;

TEST(VolumeLayout, AStackIsOneColumn) {
    const SliceLayout layout = volume_layout({128, 64, 32}, Kind::stack, 0);
    EXPECT_EQ(layout.columns, 1);
    EXPECT_EQ(layout.rows, 32);
    EXPECT_EQ(image_size({128, 64, 32}, layout), (std::array<std::int64_t, 2>{128, 2048}));
}

TEST(VolumeLayout, AnAtlasHasTheColumnsThatWereAskedFor) {
    const SliceLayout layout = volume_layout({16, 8, 10}, Kind::atlas, 4);
    EXPECT_EQ(layout.columns, 4);
    EXPECT_EQ(layout.rows, 3);
    EXPECT_EQ(volume_layout({16, 8, 10}, Kind::atlas, 25).rows, 1);
}

// By trying one after the other.
int fewest_columns(const std::array<int, 3>& size) {
    int columns = 1;
    while (columns * size[0] < (size[2] + columns - 1) / columns * size[1]) ++columns;
    return columns;
}

TEST(VolumeLayout, ChoosesTheFewestColumnsThatMakeItNoHigherThanWide) {
    EXPECT_EQ(volume_layout({128, 128, 128}, Kind::atlas, 0).columns, 12);
    EXPECT_EQ(volume_layout({1024, 1024, 1024}, Kind::atlas, 0).columns, 32);
    EXPECT_EQ(volume_layout({1, 1, 1}, Kind::atlas, 0).columns, 1);
    EXPECT_TRUE(rc::check([] {
        std::array<int, 3> size;
        for (int& side : size) side = *rc::gen::inRange(1, 400);
        const int columns = volume_layout(size, Kind::atlas, 0).columns;
        // One row of cells may still be higher than wide: then no count of columns helps.
        if (size[0] * size[2] < size[1]) {
            RC_ASSERT(columns == size[2]);
        } else {
            RC_ASSERT(columns == fewest_columns(size));
        }
    }));
}

TEST(VolumeLayout, SizesDoNotOverflow) {
    const SliceLayout layout = volume_layout({16384, 16384, 16384}, Kind::stack, 0);
    EXPECT_EQ(image_size({16384, 16384, 16384}, layout)[1], std::int64_t{1} << 28);
}

}  // namespace
}  // namespace skybake
