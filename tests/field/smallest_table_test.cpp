#include "bakers/field/smallest_table.h"

#include <gtest/gtest.h>

#include <cmath>

namespace skybake {
namespace {

// Curved along x alone, so that height buys nothing. Level 0 is cheap and off by 1e-3.
TableModel model_of(double curvature) {
    TableModel model;
    model.channels = 1;
    model.cost_per_texel = {1, 10};
    model.reference = [=](double y, const std::vector<double>& x, double* values) {
        for (const double at : x) *values++ = curvature * at * at + y;
    };
    model.row = [=](int level, double y, const std::vector<double>& x, double* values) {
        for (const double at : x) *values++ = curvature * at * at + y + (level == 0 ? 1e-3 : 0);
    };
    model.error = [](double value, double reference, double) { return value - reference; };
    return model;
}

TableSearch search(const TableModel& model, double max_error,
                   config::PixelType type = config::PixelType::float32) {
    const ReferencePoints points = reference_points(model, {256, 1}, BakeOptions{1});
    return smallest_table(model, max_error, type, points, BakeOptions{1});
}

TEST(SmallestTable, SpendsTexelsWhereTheyHelp) {
    // Interpolation is off by 1 / (4 (n-1)^2): below 1e-2 from n = 6, height 4 being the least.
    const TableSearch found = search(model_of(1), 1.2e-2);
    ASSERT_TRUE(found.found);
    EXPECT_EQ(found.found->size, (std::array<int, 2>{6, 4}))
        << found.found->size[0] << 'x' << found.found->size[1];
    EXPECT_EQ(found.found->level, 0);
    EXPECT_LE(found.found->max_error, 1.2e-2);
}

TEST(SmallestTable, TakesADearerLevelWhereTheCheapOneCannotHold) {
    const TableSearch found = search(model_of(1), 5e-4);
    ASSERT_TRUE(found.found);
    EXPECT_EQ(found.found->level, 1);
    EXPECT_EQ(found.found->size, (std::array<int, 2>{24, 4}));
}

TEST(SmallestTable, SaysHowFarItCameWhereNoneHolds) {
    const TableSearch found = search(model_of(1e4), 1e-6);
    EXPECT_FALSE(found.found);
    EXPECT_GT(found.best.max_error, 1e-6);
    EXPECT_LT(found.best.max_error, 1e-3);
}

TEST(SmallestTable, CountsThePixelType) {
    EXPECT_TRUE(search(model_of(1), 1e-4).found);
    EXPECT_FALSE(search(model_of(1), 1e-4, config::PixelType::half).found);
}

// A check that wants the table wider than the points show: errors hide where no point is.
TEST(SmallestTable, HoldsWhereACheckLooks) {
    const TableModel model = model_of(1);
    int checked = 0;
    const TableCheck check = [&](int, const Image2<float>& image) {
        ++checked;
        FoundErrors found;
        found.figures.max = image.width < 16 ? 1 : 0;
        found.worst_point[0] = 0.3;
        return found;
    };
    const ReferencePoints points = reference_points(model, {256, 1}, BakeOptions{1});
    const TableSearch found =
        smallest_table(model, 1.2e-2, config::PixelType::float32, points, BakeOptions{1}, check);
    ASSERT_TRUE(found.found);
    EXPECT_GE(found.found->size[0], 16);
    EXPECT_GT(checked, 1);
}

}  // namespace
}  // namespace skybake
