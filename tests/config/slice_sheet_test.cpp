#include "config/fields/section_decoder.h"
#include "config/sections/files.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>

namespace skybake::config {
namespace {

using Size = std::array<int, 3>;

std::array<int, 2> atlas_of(const Size& size, int columns = 0) {
    const SliceSheet sheet = slice_sheet(size, SheetLayout::atlas, columns);
    return {sheet.columns, sheet.rows};
}

std::int64_t longer_edge(const Size& size, const std::array<int, 2>& cells) {
    return std::max(std::int64_t{size[0]} * cells[0], std::int64_t{size[1]} * cells[1]);
}

TEST(SliceSheet, AStackIsOneColumn) {
    const SliceSheet sheet = slice_sheet({128, 64, 32}, SheetLayout::stack, 0);
    EXPECT_EQ(sheet.columns, 1);
    EXPECT_EQ(sheet.rows, 32);
}

// Tests the sheets that Unreal, Unity and Godot want.
TEST(SliceSheet, PowersOfTwoMakeSheetsOfPowersOfTwo) {
    EXPECT_EQ(atlas_of({128, 128, 128}), (std::array{16, 8}));
    EXPECT_EQ(atlas_of({32, 32, 32}), (std::array{8, 4}));
    EXPECT_EQ(atlas_of({64, 64, 64}), (std::array{8, 8}));
    EXPECT_EQ(atlas_of({512, 512, 128}), (std::array{16, 8}));
    EXPECT_EQ(atlas_of({256, 128, 32}), (std::array{4, 8}));
    EXPECT_EQ(atlas_of({1, 1, 1}), (std::array{1, 1}));
}

TEST(SliceSheet, HasTheColumnsThatWereAskedFor) {
    EXPECT_EQ(atlas_of({16, 8, 10}, 4), (std::array{4, 3}));
    EXPECT_EQ(atlas_of({16, 8, 10}, 25), (std::array{25, 1}));
}

// Tries all columns, whether they divide or not.
TEST(SliceSheet, NoFullSheetIsNearerToASquare) {
    EXPECT_TRUE(rc::check([] {
        Size size;
        for (int& side : size) side = *rc::gen::inRange(1, 120);
        const std::array<int, 2> chosen = atlas_of(size);
        RC_ASSERT(chosen[0] * chosen[1] == size[2]);
        for (int columns = 1; columns <= size[2]; ++columns) {
            if (size[2] % columns != 0) continue;
            RC_ASSERT(longer_edge(size, chosen) <= longer_edge(size, {columns, size[2] / columns}));
        }
    }));
}

// One row of 131 slices would be 16768 texels wide.
TEST(SliceSheet, PrimesLeaveCellsEmptyWhereOneRowIsTooLong) {
    EXPECT_EQ(atlas_of({128, 128, 127}), (std::array{127, 1}));
    EXPECT_EQ(atlas_of({128, 128, 131}), (std::array{12, 11}));
}

// Where nothing fits: full, unless a row of cells would be too long to be made.
TEST(SliceSheet, LargeVolumesAreFullToo) {
    EXPECT_EQ(atlas_of({1024, 1024, 512}), (std::array{32, 16}));
    const std::array<int, 2> huge = atlas_of({16384, 256, 8191});
    EXPECT_LE(std::int64_t{huge[0]} * 16384, widest_sheet);
    EXPECT_GE(huge[0] * huge[1], 8191);
}

TEST(SliceSheet, SizesDoNotOverflow) {
    const Size size = {16384, 16384, 16384};
    const SliceSheet sheet = slice_sheet(size, SheetLayout::stack, 0);
    EXPECT_EQ(sheet_size(size, sheet)[1], std::int64_t{1} << 28);
}

}  // namespace
}  // namespace skybake::config
