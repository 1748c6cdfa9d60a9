#include "bakers/render/tone_curve.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <cmath>

namespace skybake {
namespace {

Image2<float> texel(std::vector<float> values) {
    Image2<float> image(1, 1, static_cast<int>(values.size()));
    image.texels = std::move(values);
    return image;
}

TEST(ToneMapped, IsTheCurveThenSrgb) {
    EXPECT_TRUE(rc::check([] {
        const double exposed = *rc::gen::inRange(0, 100000) / 10000.0;
        const double exposure = *rc::gen::inRange(1, 1000) / 10.0;
        const auto radiance = static_cast<float>(exposed / exposure);
        const double linear = 1 - std::exp(-exposed);
        const double srgb =
            linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
        const Picture picture = tone_mapped(texel({radiance, 0, radiance}), exposure);
        RC_ASSERT(std::abs(picture.rgb[0] - 255 * srgb) < 0.75);
        RC_ASSERT(picture.rgb[1] == 0);
        RC_ASSERT(picture.rgb[2] == picture.rgb[0]);
    }));
}

TEST(ToneMapped, OfTheEndsIsBlackAndWhite) {
    EXPECT_EQ(tone_mapped(texel({-1, 0, 1e30F}), 1).rgb, (std::vector<std::uint8_t>{0, 0, 255}));
    EXPECT_EQ(tone_mapped(texel({0.5F}), 1).rgb, (std::vector<std::uint8_t>(3, 168)))
        << "one channel is grey: 1 - exp(-1/2) = 0.393";
}

TEST(ExposureFor, BringsThe99thPercentileTo85Percent) {
    Image2<float> image(1000, 1, 3);
    for (int x = 0; x < 1000; ++x) {
        const float value = x < 980 ? 1.0F : x < 992 ? 4.0F : 1e6F;  // a sun in 8 of 1000 texels
        std::fill_n(image.texel(x, 0), 3, value);
    }
    EXPECT_NEAR(1 - std::exp(-exposure_for(image) * 4), 0.85, 1e-6);
    EXPECT_EQ(exposure_for(texel({0, 0, 0})), 1);
    EXPECT_EQ(exposure_for(Image2<float>()), 1);
}

}  // namespace
}  // namespace skybake
