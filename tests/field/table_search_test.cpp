#include "bakers/field/table_search.h"

#include <gtest/gtest.h>

#include <cmath>

namespace skybake {
namespace {

constexpr SearchCounts kWithEstimate = {32, 16, 8, 8, 64};
constexpr SearchCounts kReferenceAlone = {32, 16, 8, 8, 0};

// A function of x and y whose texels are exact, and whose reference may be higher by `bias`.
TableModel model_of(const std::function<double(double x, double y)>& function, double bias = 0) {
    TableModel model;
    model.channels = 1;
    model.cost_per_texel = {1};
    model.row = [=](int, double y, const std::vector<double>& x, double* values) {
        for (const double at : x) *values++ = function(at, y);
    };
    model.reference = [=](double y, const std::vector<double>& x, double* values) {
        for (const double at : x) *values++ = function(at, y) + bias;
    };
    model.error = [](double value, double reference, double) { return value - reference; };
    return model;
}

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
    const TableModel model = model_of([](double, double y) { return y; }, 0.125);
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

}  // namespace
}  // namespace skybake
