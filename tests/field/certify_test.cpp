#include "bakers/field/certify.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "tests/field/table_models.h"

namespace skybake {
namespace {

// f(x, y) = x^2 + y, whose bilinear interpolant on n texels is too high by at most 1 / (4 (n-1)^2);
// `kernel_bias` is a wrong kernel.
TableModel parabola(double kernel_bias = 0) {
    return test::model_of([](double x, double y) { return x * x + y; }, {kernel_bias});
}

Image2<float> bake(const TableModel& model, int size) {
    RangeCounts range;
    return store_texels(bake_texels(model, 0, {size, size}, BakeOptions{1}),
                        config::PixelType::float32, range);
}

TEST(Certify, LookupErrorIsThatOfTheInterpolant) {
    const TableModel model = parabola();
    const ReferencePoints points = reference_points(model, {1024, 1}, BakeOptions{1});
    EXPECT_EQ(points.count(), 1024);
    for (const int size : {5, 9, 17}) {
        const MeasuredErrors errors = measure_lookups(model, bake(model, size), points);
        const double bound = 0.25 / ((size - 1) * (size - 1));
        EXPECT_NEAR(errors.figures.max, bound, 0.05 * bound);
        EXPECT_NEAR(errors.figures.rms, bound * std::sqrt(8.0 / 15), 0.05 * bound);
        const double texel = errors.worst[0] * (size - 1);
        EXPECT_NEAR(texel - std::floor(texel), 0.5, 0.1) << "half way between two texels";
    }
}

TEST(Certify, TexelErrorSeesTheKernelAndNotTheInterpolation) {
    const TableModel model = parabola(1e-3);
    const ReferencePoints texels = reference_texels(model, {9, 9}, {64, 1}, BakeOptions{1});
    EXPECT_EQ(texels.count(), 64);
    const MeasuredErrors errors = measure_lookups(model, bake(model, 9), texels);
    EXPECT_NEAR(errors.figures.max, 1e-3, 1e-6);
    EXPECT_NEAR(errors.figures.rms, 1e-3, 1e-6);
    EXPECT_NEAR(measure_kernel(model, 0, texels, BakeOptions{1}).figures.max, 1e-3, 1e-12);
}

TEST(Certify, SmallTablesAreMeasuredAtEveryTexel) {
    const TableModel model = parabola();
    EXPECT_EQ(reference_texels(model, {3, 5}, {8, 8}, BakeOptions{1}).count(), 15);
    EXPECT_EQ(reference_texels(model, {1, 1}, {8, 8}, BakeOptions{1}).count(), 1);
}

// Channels of scales 1, 100 and 0.001, one of which is off by 2 % of its scale at one texel, or at all.
TEST(Certify, EachChannelIsMeasuredByItsOwnScale) {
    constexpr std::array<double, 3> kScale = {1, 100, 1e-3};
    for (std::size_t off = 0; off < 3; ++off) {
        for (const bool everywhere : {true, false}) {
            TableModel model;
            model.channels = 3;
            model.cost_per_texel = {1};
            model.reference = [&](double y, const std::vector<double>& x, double* values) {
                for (const double at : x) {
                    for (const double scale : kScale) *values++ = scale * (at + y) / 2;
                }
            };
            model.row = [&](int, double y, const std::vector<double>& x, double* values) {
                model.reference(y, x, values);
                for (std::size_t i = 0; i < x.size(); ++i) {
                    const bool is_wrong = everywhere || (y == 0.5 && x[i] > 0.6 && x[i] < 0.7);
                    values[3 * i + off] -= is_wrong ? 0.02 * kScale[off] : 0;
                }
            };
            model.error = [](double value, double reference, double scale) {
                return (value - reference) / scale;
            };
            const ReferencePoints texels = reference_texels(model, {4, 3}, {64, 1}, BakeOptions{1});
            const MeasuredErrors errors = measure_kernel(model, 0, texels, BakeOptions{1});
            EXPECT_NEAR(errors.figures.max, 0.02, 1e-12) << off;
            const double share = everywhere ? 1.0 / 3 : 1.0 / 36;
            EXPECT_NEAR(errors.figures.rms, 0.02 * std::sqrt(share), 1e-12) << off;
            if (everywhere) continue;
            EXPECT_NEAR(errors.worst[0], 2.0 / 3, 1e-12) << off;
            EXPECT_EQ(errors.worst[1], 0.5) << off;
        }
    }
}

TEST(Certify, NotANumberIsNeverSmall) {
    TableModel model = parabola();
    model.row = [](int, double, const std::vector<double>& x, double* values) {
        for (std::size_t i = 0; i < x.size(); ++i) *values++ = i == 0 ? NAN : 0;
    };
    const ReferencePoints texels = reference_texels(model, {3, 3}, {64, 1}, BakeOptions{1});
    EXPECT_FALSE(measure_kernel(model, 0, texels, BakeOptions{1}).figures.max <= 1e30);
}

}  // namespace
}  // namespace skybake
