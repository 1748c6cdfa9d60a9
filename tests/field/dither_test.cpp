// Dithered texels keep what rounding to nearest loses: the mean of smooth gradients.
#include "bakers/field/dither.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "bakers/field/pixel_type.h"
#include "bakers/field/table_model.h"
#include "config/sections/files.h"

namespace skybake {
namespace {

constexpr int kEdge = 64;

TexelRounding dithered(PixelType type) {
    config::AssetFiles files;
    files.pixel_type = type;
    files.dither = true;
    return files;
}

struct Errors {
    double block = 0;  // the largest one of a mean over 8 x 8 texels, in steps
    double texel = 0;
};

// A gradient of `slope` steps per texel, in three channels.
Errors errors_of(double slope, double angle, double steps, TexelRounding rounding) {
    Image2<double> exact(kEdge, kEdge, 3);
    for (int i = 0; i < kEdge * kEdge; ++i) {
        const double along = std::cos(angle) * (i % kEdge) + std::sin(angle) * (i / kEdge);
        std::fill_n(exact.texel(i % kEdge, i / kEdge), 3, (40.37 + slope * along) / steps);
    }
    RangeCounts range;
    const Image2<float> found = store_texels(exact, rounding, range);
    std::vector<double> sums(kEdge * kEdge / 64 * 3);
    Errors errors;
    for (int i = 0; i < 3 * kEdge * kEdge; ++i) {
        const auto at = static_cast<std::size_t>(i);
        const double error = (double{found.texels[at]} - exact.texels[at]) * steps;
        const int block = i / 3 % kEdge / 8 + i / 3 / kEdge / 8 * (kEdge / 8);
        sums[static_cast<std::size_t>(3 * block + i % 3)] += error / 64;
        errors.texel = std::max(errors.texel, std::fabs(error));
    }
    for (const double sum : sums) errors.block = std::max(errors.block, std::fabs(sum));
    return errors;
}

// A gradient of a step in twenty or more texels is a staircase, whose treads are off by nearly half a step.
TEST(Dither, KeepsTheMeanOfSmoothGradients) {
    for (const PixelType type : {PixelType::unorm8, PixelType::unorm16}) {
        const double steps = type == PixelType::unorm8 ? 255 : 65535;
        for (const double slope : {1.0 / 20, 1.0 / 33, 1.0 / 64, 0.0}) {
            for (const double angle : {0.0, 0.4, 0.9, 1.5}) {
                EXPECT_GT(errors_of(slope, angle, steps, type).block, 0.2) << slope << ' ' << angle;
                const Errors found = errors_of(slope, angle, steps, dithered(type));
                EXPECT_LT(found.block, 0.1) << slope << ' ' << angle;
                EXPECT_GT(found.texel, 0.5);
                EXPECT_LT(found.texel, 1);
            }
        }
    }
}

TEST(Dither, LeavesStepsAndWhatHasNoneAsTheyAre) {
    const auto expect_nearest = [](double value, PixelType type) {
        for (int x = 0; x < 128; ++x) {
            ASSERT_EQ(round_texel(value, dithered(type), {x, 3 * x}, x % 4),
                      round_to_pixel_type(value, type))
                << value;
        }
    };
    for (const PixelType type : {PixelType::unorm8, PixelType::unorm16}) {
        for (int step = 0; step <= 255; ++step) {
            expect_nearest(double{round_to_pixel_type(step / 255.0, type)}, type);
        }
        for (const double beyond : {-0.1, 1.001, 7.5}) expect_nearest(beyond, type);
    }
    for (const PixelType type : {PixelType::float32, PixelType::half})
        expect_nearest(0.12345, type);
}

// A part of a table is rounded as the whole one is, and channels are not rounded alike.
TEST(Dither, FollowsFromThePlaceInTheTable) {
    const auto of = [](int edge, std::array<int, 2> first) {
        Image2<double> image(edge, edge, 3);
        std::ranges::fill(image.texels, 0.3);
        RangeCounts range;
        return store_texels(image, dithered(PixelType::unorm8), range, first);
    };
    const Image2<float> whole = of(kEdge, {0, 0});
    const Image2<float> part = of(4, {20, 31});
    int apart = 0;
    for (int i = 0; i < 16; ++i) {
        const float* texel = whole.texel(20 + i % 4, 31 + i / 4);
        EXPECT_TRUE(std::equal(texel, texel + 3, part.texel(i % 4, i / 4)));
        apart += texel[0] != texel[1] || texel[1] != texel[2];
    }
    EXPECT_GT(apart, 4);
}

}  // namespace
}  // namespace skybake
