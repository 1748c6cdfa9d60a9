#include "bakers/io/formats/sheet.h"

#include "tests/io/files.h"

namespace skybake {
namespace {

using Kind = config::SheetLayout;

TEST(SheetLayout, AStackIsOneColumn) {
    const SheetGrid layout = testing::grid_of({128, 64, 32}, Kind::stack, 0);
    EXPECT_EQ(layout.columns, 1);
    EXPECT_EQ(layout.rows, 32);
    EXPECT_EQ(image_size({128, 64, 32}, layout), (std::array<std::int64_t, 2>{128, 2048}));
}

TEST(SheetLayout, AnAtlasHasTheColumnsThatWereAskedFor) {
    const SheetGrid layout = testing::grid_of({16, 8, 10}, Kind::atlas, 4);
    EXPECT_EQ(layout.columns, 4);
    EXPECT_EQ(layout.rows, 3);
    EXPECT_EQ(testing::grid_of({16, 8, 10}, Kind::atlas, 25).rows, 1);
}

TEST(SheetLayout, AnAtlasWithoutColumnsHasThoseOfItsSheet) {
    const SheetGrid layout = testing::grid_of({128, 128, 128}, Kind::atlas, 0);
    EXPECT_EQ(layout.kind, Kind::atlas);
    EXPECT_EQ(layout.columns, 16);
    EXPECT_EQ(layout.rows, 8);
    EXPECT_EQ(sheet_line({128, 128, 128}, layout),
              "atlas of 16 x 8 cells of 128 x 128 texels, 128 slices row by row from the top left, "
              "row 0 first");
}

TEST(SheetLayout, SizesDoNotOverflow) {
    const SheetGrid layout = testing::grid_of({16384, 16384, 16384}, Kind::stack, 0);
    EXPECT_EQ(image_size({16384, 16384, 16384}, layout)[1], std::int64_t{1} << 28);
}

}  // namespace
}  // namespace skybake
