#include <gtest/gtest.h>

#include <cmath>

#include "bakers/field/smallest_table.h"
#include "tests/field/table_models.h"

namespace skybake {
namespace {

using test::model_of;

constexpr SearchCounts kWithEstimate = {32, 16, 8, 8, 64};
constexpr SearchCounts kReferenceAlone = {32, 16, 8, 8, 0};

FoundErrors search(const TableModel& model, std::array<int, 2> size, const SearchCounts& counts,
                   int threads = 2) {
    RangeCounts range;
    const Image2<float> image = store_texels(bake_texels(model, 0, size, BakeOptions{1}),
                                             config::PixelType::float32, range);
    return search_table(model, 0, image, counts, BakeOptions{threads});
}

// Flat but for a wall, which is thinner than a cell.
constexpr double kWall = 0.4031;
double wall(double x, double) { return std::tanh(2000 * (x - kWall)); }

TEST(TableSearch, FindsTheErrorOfAParabola) {
    const TableModel model = model_of([](double x, double y) { return x * x + y; });
    // With one row, all of the mean square is that row's.
    constexpr SearchCounts kOneRow = {1, 512, 0, 8, 0};
    for (const SearchCounts& counts : {kWithEstimate, kReferenceAlone, kOneRow}) {
        const FoundErrors found = search(model, {9, 5}, counts);
        const double bound = 0.25 / 64;
        EXPECT_NEAR(found.figures.max, bound, 0.01 * bound);
        EXPECT_NEAR(found.figures.rms, bound * std::sqrt(8.0 / 15), 0.05 * bound);
    }
}

TEST(TableSearch, FindsAWallThatFewCellsHold) {
    const TableModel model = model_of(wall);
    const FoundErrors found = search(model, {128, 64}, kWithEstimate);
    // The wall lies at the share s of a cell: lookups at t are off by 2 t before it, by 2 t - 2
    // beyond.
    const double s = kWall * 127 - std::floor(kWall * 127);
    EXPECT_GT(found.figures.max, 0.75 * 2 * (1 - s));
    EXPECT_LE(found.figures.max, 2 * (1 - s));
    EXPECT_NEAR(found.worst_point[0], kWall, 1.0 / 127);
    const double rms = std::sqrt(4.0 / 3 * (std::pow(s, 3) + std::pow(1 - s, 3)) / 127);
    EXPECT_NEAR(found.figures.rms, rms, 0.2 * rms);
    EXPECT_EQ(found.points, 64);
}

TEST(TableSearch, SeesWhatTheEstimateLeavesOut) {
    const TableModel model = model_of([](double, double y) { return y + 0.125; }, {-0.125});
    const FoundErrors found = search(model, {9, 5}, kWithEstimate);
    EXPECT_NEAR(found.figures.max, 0.125, 1e-6);
    EXPECT_NEAR(found.figures.rms, 0.125, 0.0125);  // an estimate
}

TEST(TableSearch, NotANumberIsNeverSmall) {
    TableModel model = model_of([](double x, double y) { return x + y; });
    model.reference = [](double, const std::vector<double>& x, double* values) {
        for (std::size_t i = 0; i < x.size(); ++i) *values++ = NAN;
    };
    EXPECT_FALSE(search(model, {9, 5}, kReferenceAlone).figures.max <= 1e30);
}

TEST(TableSearch, IsTheSameForAnyNumberOfThreads) {
    const TableModel model = model_of(wall);
    const FoundErrors one = search(model, {128, 64}, kWithEstimate, 1);
    const FoundErrors three = search(model, {128, 64}, kWithEstimate, 3);
    EXPECT_EQ(one.figures.max, three.figures.max);
    EXPECT_EQ(one.figures.rms, three.figures.rms);
    EXPECT_EQ(one.worst_point, three.worst_point);
}

// Curved along x alone, so that height buys nothing. Level 0 is cheap and off by 1e-3.
TableModel curve_of(double curvature) {
    return model_of([=](double x, double y) { return curvature * x * x + y; }, {1e-3, 0});
}

TableSearch search(const TableModel& model, double max_error,
                   config::PixelType type = config::PixelType::float32) {
    const ReferencePoints points = reference_points(model, {256, 1}, BakeOptions{1});
    return smallest_table(model, max_error, type, points, BakeOptions{1});
}

TEST(SmallestTable, SpendsTexelsWhereTheyHelp) {
    // Interpolation is off by 1 / (4 (n-1)^2): below 1e-2 from n = 6, height 4 being the least.
    const TableSearch found = search(curve_of(1), 1.2e-2);
    ASSERT_TRUE(found.found);
    EXPECT_EQ(found.found->size, (std::array<int, 2>{6, 4}))
        << found.found->size[0] << 'x' << found.found->size[1];
    EXPECT_EQ(found.found->level, 0);
    EXPECT_LE(found.found->max_error, 1.2e-2);
}

TEST(SmallestTable, TakesADearerLevelWhereTheCheapOneCannotHold) {
    const TableSearch found = search(curve_of(1), 5e-4);
    ASSERT_TRUE(found.found);
    EXPECT_EQ(found.found->level, 1);
    EXPECT_EQ(found.found->size, (std::array<int, 2>{24, 4}));
}

TEST(SmallestTable, SaysHowFarItCameWhereNoneHolds) {
    const TableSearch found = search(curve_of(1e4), 1e-6);
    EXPECT_FALSE(found.found);
    EXPECT_GT(found.best.max_error, 1e-6);
    EXPECT_LT(found.best.max_error, 1e-3);
}

TEST(SmallestTable, CountsThePixelType) {
    EXPECT_TRUE(search(curve_of(1), 1e-4).found);
    EXPECT_FALSE(search(curve_of(1), 1e-4, config::PixelType::half).found);
}

// A check that wants the table wider than the points show: errors hide where no point is.
TEST(SmallestTable, HoldsWhereACheckLooks) {
    const TableModel model = curve_of(1);
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
