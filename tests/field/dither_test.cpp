// Dithered texels keep what rounding to nearest loses: the mean of smooth gradients.
#include "bakers/field/dither.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "bakers/field/pixel_type.h"
#include "bakers/field/table_model.h"

namespace skybake {
namespace {

using config::PixelType;

constexpr int kEdge = 64;
constexpr int kChannels = 3;

config::AssetFiles files_of(PixelType type, bool dither) {
    config::AssetFiles files;
    files.pixel_type = type;
    files.dither = dither;
    return files;
}

double steps_of(PixelType type) { return type == PixelType::unorm8 ? 255 : 65535; }

Image2<double> image_of(const std::function<double(int x, int y)>& value) {
    Image2<double> image(kEdge, kEdge, kChannels);
    for (int y = 0; y < kEdge; ++y) {
        for (int x = 0; x < kEdge; ++x) std::fill_n(image.texel(x, y), kChannels, value(x, y));
    }
    return image;
}

Image2<float> stored(const Image2<double>& texels, TexelRounding rounding) {
    RangeCounts range;
    return store_texels(texels, rounding, range);
}

struct Errors {
    double block = 0;  // largest error of a mean over 8 x 8 texels and over `channels`, in steps
    double texel = 0;
};

Errors errors_of(const Image2<double>& exact, const Image2<float>& found, double steps) {
    Errors errors;
    for (int y = 0; y < kEdge; y += 8) {
        for (int x = 0; x < kEdge; x += 8) {
            for (int c = 0; c < kChannels; ++c) {
                double sum = 0;
                for (int i = 0; i < 64; ++i) {
                    const double error = (double{found.texel(x + i % 8, y + i / 8)[c]} -
                                          exact.texel(x + i % 8, y + i / 8)[c]) *
                                         steps;
                    sum += error / 64;
                    errors.texel = std::max(errors.texel, std::fabs(error));
                }
                errors.block = std::max(errors.block, std::fabs(sum));
            }
        }
    }
    return errors;
}

// A gradient of a step in twenty or more texels is a staircase, whose treads are off by nearly half a step.
TEST(Dither, KeepsTheMeanOfSmoothGradients) {
    for (const PixelType type : {PixelType::unorm8, PixelType::unorm16}) {
        const double steps = steps_of(type);
        for (const double slope : {1.0 / 20, 1.0 / 33, 1.0 / 64, 0.0}) {
            for (const double angle : {0.0, 0.4, 0.9, 1.5}) {
                const Image2<double> exact = image_of([&](int x, int y) {
                    return (40.37 + slope * (std::cos(angle) * x + std::sin(angle) * y)) / steps;
                });
                const Errors plain = errors_of(exact, stored(exact, type), steps);
                const Errors found = errors_of(exact, stored(exact, files_of(type, true)), steps);
                EXPECT_GT(plain.block, 0.2) << slope << ' ' << angle;
                EXPECT_LT(found.block, 0.1) << slope << ' ' << angle;
                EXPECT_GT(found.texel, 0.5);
                EXPECT_LT(found.texel, 1);
            }
        }
    }
}

TEST(Dither, LeavesStepsAsTheyAre) {
    for (const PixelType type : {PixelType::unorm8, PixelType::unorm16}) {
        for (int step = 0; step <= 255; ++step) {
            const double value = double{round_to_pixel_type(step / 255.0, type)};
            for (int x = 0; x < 128; ++x) {
                const auto found = round_texel(value, files_of(type, true), {x, 3 * x}, x % 4);
                ASSERT_EQ(found, round_to_pixel_type(value, type)) << step;
            }
        }
    }
}

TEST(Dither, LeavesOtherTypesAndOtherValuesAsTheyAre) {
    for (const double value : {0.12345, -0.1, 1.001, 7.5}) {
        const bool is_beyond = value != 0.12345;
        for (const PixelType type : {PixelType::float32, PixelType::half, PixelType::unorm8}) {
            if (type == PixelType::unorm8 && !is_beyond) continue;
            for (int x = 0; x < 64; ++x) {
                EXPECT_EQ(round_texel(value, files_of(type, true), {x, 5}, 0),
                          round_to_pixel_type(value, type));
            }
        }
    }
}

// A part of a table is rounded as the whole one is, and channels are not rounded alike.
TEST(Dither, FollowsFromThePlaceInTheTable) {
    const Image2<double> exact = image_of([](int, int) { return 0.3; });
    const TexelRounding rounding = files_of(PixelType::unorm8, true);
    const Image2<float> whole = stored(exact, rounding);
    Image2<double> corner(5, 4, kChannels);
    std::ranges::fill(corner.texels, 0.3);
    RangeCounts range;
    const Image2<float> part = store_texels(corner, rounding, range, {20, 31});
    int apart = 0;
    for (int y = 0; y < 4; ++y) {
        for (int x = 0; x < 5; ++x) {
            const float* texel = whole.texel(20 + x, 31 + y);
            EXPECT_TRUE(std::equal(texel, texel + kChannels, part.texel(x, y)));
            apart += texel[0] != texel[1] || texel[1] != texel[2];
        }
    }
    EXPECT_GT(apart, 5);
}

}  // namespace
}  // namespace skybake
