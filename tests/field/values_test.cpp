#include <gtest/gtest.h>

#include <cmath>

#include "bakers/field/choose_probes.h"
#include "bakers/field/interpolation.h"
#include "bakers/field/pixel_type.h"
#include "bakers/math/facts.h"
#include "bakers/math/hash.h"
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

}  // namespace
}  // namespace skybake
