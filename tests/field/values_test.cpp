#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "bakers/field/choose_probes.h"
#include "bakers/field/dither.h"
#include "bakers/field/interpolation.h"
#include "bakers/field/pixel_type.h"
#include "bakers/field/table_model.h"
#include "bakers/math/facts.h"
#include "bakers/math/hash.h"
#include "config/sections/files.h"
#include "tests/field/readable_texture.h"

namespace skybake {

namespace {

// From the test vectors of the XXH3 specification: the empty input with seed 0.
TEST(Hash, EqualsTheSpecification) { EXPECT_EQ(xxh3_hex(""), "99aa06d3014798d86001c324468d497f"); }

TEST(Hash, ChangesWithEachBit) {
    EXPECT_NE(xxh3_hex("skybake"), xxh3_hex("skybakf"));
    EXPECT_EQ(xxh3_hex("skybake").size(), 32u);
}

TEST(Facts, TextsAreThoseOfTheValues) {
    EXPECT_EQ(fact_text("words"), "words");
    EXPECT_EQ(fact_text(12.0), "12");
    EXPECT_EQ(fact_text(0.1), "0.1");
    EXPECT_EQ(fact_text(std::vector<double>{30, 3, -4.5}), "30, 3, -4.5");
    EXPECT_EQ(fact_text(std::vector<double>()), "");
    const Facts facts = {{"a", 1.0}, {"b", "two"}};
    EXPECT_EQ(fact_named(facts, "b"), "two");
    EXPECT_EQ(fact_named(facts, "c"), "");
}

TEST(Facts, RoundsToDecimalDigits) {
    EXPECT_EQ(to_digits(10.000000000000002, 9), 10);
    EXPECT_EQ(to_digits(1.0 / 3, 3), 0.333);
    EXPECT_EQ(to_digits(-6360123.4567, 9), -6360123.46);
    EXPECT_EQ(to_digits(0, 9), 0);
    EXPECT_EQ(to_digits(std::vector<double>{1.26, 0.0126}, 2), (std::vector<double>{1.3, 0.013}));
    EXPECT_EQ(to_shortest(0.3f), 0.3);
    EXPECT_NE(to_shortest(0.3f), double{0.3f});
}

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

TEST(ProbeValue, AllowsForFilteringInTwoHundredAndFiftySixths) {
    Image2<float> image(4, 4, 1);
    for (std::size_t i = 0; i < image.texels.size(); ++i) {
        image.texels[i] = static_cast<float>(i * i);
    }
    const ProbedTexture texture = {
        testing::readable_texture(image), 2, config::PixelType::float32, {225}};
    for (double u = 0.05; u < 1; u += 0.09) {
        for (double v = 0.05; v < 1; v += 0.13) {
            const ProbeValue probe = probe_value(texture, {{{u, v, 0.5}}});
            // A lookup whose weights are rounded to multiples of 1/256.
            const auto rounded = [](double t, int size) {
                return (std::round((t * size - 0.5) * 256) / 256 + 0.5) / size;
            };
            double value = 0;
            bilinear(image, rounded(u, 4), rounded(v, 4), &value);
            EXPECT_NEAR(value, probe.value[0], probe.tolerance[0]);
            // Half a texel off is not allowed for.
            bilinear(image, u + 0.125, v, &value);
            if (u > 0.125 && u < 0.75) {
                EXPECT_GT(std::fabs(value - probe.value[0]), probe.tolerance[0]);
            }
        }
    }
}

// Dithered texels keep what rounding to nearest loses: the mean of smooth gradients.

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
