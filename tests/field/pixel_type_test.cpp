#include "bakers/field/pixel_type.h"

#include <gtest/gtest.h>

#include <cmath>

namespace skybake {
namespace {

using config::PixelType;

TEST(PixelType, RoundsToNearest) {
    EXPECT_EQ(round_to_pixel_type(0.1, PixelType::float32), 0.1F);
    EXPECT_EQ(round_to_pixel_type(1.0 + 0x1p-11 + 0x1p-12, PixelType::half), 1.0F + 0x1p-10F);
    EXPECT_EQ(round_to_pixel_type(1.0 + 0x1p-12, PixelType::half), 1.0F);
    EXPECT_EQ(round_to_pixel_type(65504.0, PixelType::half), 65504.0F);
    EXPECT_TRUE(std::isinf(round_to_pixel_type(65536.0, PixelType::half)));
}

TEST(PixelType, ErrorIsWithinItsBound) {
    for (const PixelType type : {PixelType::float32, PixelType::half}) {
        for (double x = 1e-3; x < 1e3; x *= 1.0137) {
            EXPECT_LE(std::fabs(round_to_pixel_type(x, type) - x), rounding_error(type) * x);
        }
    }
}

TEST(PixelType, CountsWhatItHoldsBadly) {
    RangeCounts counts;
    store(0, PixelType::half, counts);
    store(1, PixelType::half, counts);
    EXPECT_EQ(counts.below_normal, 0);
    store(6e-5, PixelType::half, counts);
    store(1e-20, PixelType::half, counts);
    EXPECT_EQ(counts.below_normal, 2);
    store(1e5, PixelType::half, counts);
    EXPECT_EQ(counts.above_range, 1);
    store(1e-40, PixelType::float32, counts);
    EXPECT_EQ(counts.below_normal, 3);
}

}  // namespace
}  // namespace skybake
