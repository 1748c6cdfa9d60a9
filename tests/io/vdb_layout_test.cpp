#include "bakers/io/formats/vdb/vdb_tree.h"

#include <gtest/gtest.h>

namespace skybake {
namespace {

TEST(VdbLayout, XIsSlowestAndZFastest) {
    const auto cells = cells_in_tree_order({{}, {16, 9, 17}}, 8);
    ASSERT_EQ(cells.size(), 2U * 2U * 3U);
    EXPECT_EQ(cells[1].origin, (std::array{0, 0, 8}));
    EXPECT_EQ(cells[3].origin, (std::array{0, 8, 0}));
    EXPECT_EQ(cells[6].origin, (std::array{8, 0, 0}));
}

TEST(VdbLayout, TheLastCellsAreCut) {
    const auto cells = cells_in_tree_order({{128, 0, 0}, {9, 1, 17}}, 8);
    EXPECT_EQ(cells.front().origin, (std::array{128, 0, 0}));
    EXPECT_EQ(cells.front().size, (std::array{8, 1, 8}));
    EXPECT_EQ(cells.back().origin, (std::array{136, 0, 16}));
    EXPECT_EQ(cells.back().size, (std::array{1, 1, 1}));
}

TEST(VdbLayout, CellsMayHaveEdgesOfTheirOwn) {
    const auto cells = cells_in_tree_order({{}, {128, 100, 128}}, {128, 32, 128});
    ASSERT_EQ(cells.size(), 4U);
    EXPECT_EQ(cells[3].origin, (std::array{0, 96, 0}));
    EXPECT_EQ(cells[3].size, (std::array{128, 4, 128}));
}

}  // namespace
}  // namespace skybake
