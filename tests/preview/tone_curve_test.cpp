#include "bakers/render/tone_curve.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "tests/support/loops.h"

namespace skybake {
namespace {

Image2<float> texel(std::vector<float> values) {
    Image2<float> image(1, 1, static_cast<int>(values.size()));
    image.texels = std::move(values);
    return image;
}

constexpr int kEdge = 64;
constexpr std::array kCurves = {ToneCurve::film, ToneCurve::exponential, ToneCurve::aces,
                                ToneCurve::agx};

// A picture of one colour, whose pixels have many thresholds.
Picture field(const std::vector<float>& values, double exposure,
              ToneCurve curve = ToneCurve::exponential) {
    Image2<float> image(kEdge, kEdge, static_cast<int>(values.size()));
    testing::for_each_texel(kEdge, kEdge, [&](int x, int y) {
        std::copy(values.begin(), values.end(), image.texel(x, y));
    });
    return tone_mapped(image, exposure, curve);
}

double mean_of(const Picture& picture, std::size_t channel) {
    double sum = 0;
    for (std::size_t i = channel; i < picture.rgb.size(); i += 3) sum += picture.rgb[i];
    return sum / (kEdge * kEdge);
}

double srgb_of(double linear) {
    return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
}

double linear_of(double srgb) {
    return srgb <= 0.04045 ? srgb / 12.92 : std::pow((srgb + 0.055) / 1.055, 2.4);
}

std::array<double, 3> linear_shown(const std::vector<float>& light, double exposure,
                                   ToneCurve curve) {
    const Picture picture = field(light, exposure, curve);
    std::array<double, 3> linear;
    for (std::size_t c = 0; c < 3; ++c) linear[c] = linear_of(mean_of(picture, c) / 255);
    return linear;
}

// Display-linear light of grey.
double shown(double light, ToneCurve curve) {
    return linear_of(mean_of(field({static_cast<float>(light)}, 1, curve), 0) / 255);
}

// Each byte is one of the two next to the exact value, and their mean is the exact value: without
// thresholds it would be up to half a byte off.
TEST(ToneMapped, IsTheCurveThenSrgbOnAverage) {
    EXPECT_TRUE(rc::check([] {
        const double exposed = *rc::gen::inRange(0, 100000) / 10000.0;
        const double exposure = *rc::gen::inRange(1, 1000) / 10.0;
        const auto radiance = static_cast<float>(exposed / exposure);
        const double exact = 255 * srgb_of(1 - std::exp(-exposed));
        const double half = 255 * srgb_of(1 - std::exp(-exposed / 2));
        const Picture picture = field({radiance, radiance / 2, radiance}, exposure);
        for (std::size_t i = 0; i < picture.rgb.size(); i += 3) {
            RC_ASSERT(std::abs(picture.rgb[i] - exact) < 1.006);
            RC_ASSERT(std::abs(picture.rgb[i + 1] - half) < 1.006);
            RC_ASSERT(picture.rgb[i + 2] == picture.rgb[i]);
        }
        RC_ASSERT(std::abs(mean_of(picture, 0) - exact) < 0.02);
        RC_ASSERT(std::abs(mean_of(picture, 1) - half) < 0.02);
    }));
}

// Small squares have the mean too, or the thresholds would be seen as a pattern.
TEST(ToneMapped, HasEvenThresholds) {
    const double light = 0.5;
    const double exact = 255 * srgb_of(1 - std::exp(-light));
    const Picture picture = field({static_cast<float>(light)}, 1);
    for (std::size_t top = 0; top + 4 <= kEdge; ++top) {
        for (std::size_t left = 0; left + 4 <= kEdge; ++left) {
            double sum = 0;
            for (std::size_t i = 0; i < 16; ++i) {
                sum += picture.rgb[3 * ((top + i / 4) * kEdge + left + i % 4)];
            }
            EXPECT_LT(std::abs(sum / 16 - exact), 0.2) << left << ", " << top;
        }
    }
}

TEST(ToneMapped, OfTheEndsIsBlackAndWhite) {
    for (const ToneCurve curve : kCurves) {
        const std::vector<float> ends = {-1, 0, 1e30F};
        for (const float light : ends) {
            const Picture picture = field({light}, 1, curve);
            const int wanted = light > 0 ? 254 : 0;  // curves of polynomials end just below 255
            for (const std::uint8_t byte : picture.rgb) {
                EXPECT_GE(byte, wanted) << tone_curve_name(curve);
                EXPECT_LE(byte, light > 0 ? 255 : 0) << tone_curve_name(curve);
            }
        }
    }
    EXPECT_NEAR(mean_of(field({0.5F}, 1), 1), 168.37, 0.02)
        << "one channel is grey: 1 - exp(-1/2) = 0.393";
}

// Compares with the curves' authors on middle grey: the Academy's transform shows 0.18 as a tenth of white,
// AgX as half of a screen's range with a gamma of 2.2. Both are fits of a few per cent. Uchimura's straight
// part shows grey as it is.
TEST(ToneMapped, ShowsMiddleGreyAsPublished) {
    EXPECT_NEAR(shown(0.18, ToneCurve::aces), 0.10, 0.01);
    EXPECT_NEAR(shown(0.18, ToneCurve::agx), std::pow(0.5, 2.2), 0.01);
    EXPECT_NEAR(shown(0.18, ToneCurve::exponential), 1 - std::exp(-0.18), 1e-3);
    for (const double grey : {0.22, 0.36, 0.53}) {
        EXPECT_NEAR(shown(grey, ToneCurve::film), grey, 1e-3);
    }
    // His toe and his shoulder, by hand: 0.22 (x / 0.22)^1.33, blended, and 1 - 0.468 / e.
    EXPECT_NEAR(shown(0.05, ToneCurve::film), 0.0332, 3e-4);
    EXPECT_NEAR(shown(1, ToneCurve::film), 0.8278, 1e-3);
}

TEST(ToneMapped, BrightensWithLightAndKeepsGreyGrey) {
    for (const ToneCurve curve : kCurves) {
        double last = 0;
        for (float light = 0.001F; light < 30; light *= 1.3F) {
            const Picture picture = field({light, light, light}, 1, curve);
            EXPECT_GE(mean_of(picture, 0), last) << tone_curve_name(curve) << ' ' << light;
            last = mean_of(picture, 0);
            EXPECT_NEAR(mean_of(picture, 1), last, 0.3) << tone_curve_name(curve) << ' ' << light;
            EXPECT_NEAR(mean_of(picture, 2), last, 0.3) << tone_curve_name(curve) << ' ' << light;
        }
    }
}

// The channels of light that the exponential shows.
std::array<double, 3> light_shown(const std::vector<float>& light) {
    std::array<double, 3> channels = linear_shown(light, 1, ToneCurve::exponential);
    for (double& channel : channels) channel = -std::log(1 - channel);
    return channels;
}

// The Reference Gamut Compression keeps what is well within the gamut, and its limits, 1.147, 1.264 and
// 1.312 of the greatest channel from it, fall on the gamut's border.
TEST(ToneMapped, DrawsColorsIntoTheGamut) {
    const std::array<double, 3> kept = light_shown({0.2F, 0.21F, 1});
    EXPECT_NEAR(kept[0], 0.2, 2e-3);
    EXPECT_NEAR(kept[1], 0.21, 2e-3);
    EXPECT_NEAR(kept[2], 1, 2e-3);
    constexpr std::array limits = {1.147, 1.264, 1.312};
    for (std::size_t c = 0; c < 3; ++c) {
        std::vector<float> light = {0.5F, 0.5F, 0.5F};
        light[(c + 1) % 3] = 1;
        light[c] = static_cast<float>(1 - limits[c] + 0.02);
        EXPECT_GT(light_shown(light)[c], 5e-4) << c;
        light[c] = static_cast<float>(1 - limits[c] - 0.02);
        EXPECT_EQ(light_shown(light)[c], 0) << c;
    }
}

// A setting sun of (1, 0.08, -0.03) that is a thousand times too bright is no yellow without blue.
TEST(ToneMapped, ShowsTheSettingSunNoMoreYellowThanTheSkyAroundIt) {
    const Picture sun = field({1000, 80, -30}, 1);
    const Picture sky = field({2.5F, 1.5F, 0.5F}, 1);
    for (std::size_t c = 0; c < 3; ++c) EXPECT_GE(mean_of(sun, c), mean_of(sky, c)) << c;
}

// A saturated blue that is far too bright turns to white by the film-like curves, and not by the
// exponential.
TEST(ToneMapped, DesaturatesBrightColorsByFilmLikeCurves) {
    const std::vector<float> blue = {0.2F, 0.4F, 1};
    const auto spread = [&](ToneCurve curve) {
        const Picture picture = field(blue, 4, curve);
        return mean_of(picture, 2) - mean_of(picture, 0);
    };
    EXPECT_GT(spread(ToneCurve::exponential), 40);
    EXPECT_LT(spread(ToneCurve::aces), 0.8 * spread(ToneCurve::exponential));
    EXPECT_LT(spread(ToneCurve::agx), 0.8 * spread(ToneCurve::exponential));
    // 1 - 1 / (1 + 0.15 (64 - 1)) of white is mixed in, and a channel of 12.8 alone is white too.
    EXPECT_NEAR(linear_shown(blue, 64, ToneCurve::film)[0], 0.85 * (0.2 + 0.8 * 0.904) + 0.15,
                0.01);
}

// The hue in degrees by Oklab (Ottosson 2020).
double hue_of(const std::array<double, 3>& linear) {
    const auto [r, g, b] = linear;
    const double l = std::cbrt(0.4122214708 * r + 0.5363325363 * g + 0.0514459929 * b);
    const double m = std::cbrt(0.2119034982 * r + 0.6806995451 * g + 0.1073969566 * b);
    const double s = std::cbrt(0.0883024619 * r + 0.2817188376 * g + 0.6299787005 * b);
    return std::atan2(0.0259040371 * l + 0.7827717662 * m - 0.8086757660 * s,
                      1.9779984951 * l - 2.4285922050 * m + 0.4505937099 * s) *
           180 / std::numbers::pi;
}

// How far the hue turns, either way, while light grows from a quarter of white by six stops.
double most_turn(const std::array<double, 3>& light, ToneCurve curve) {
    double most = 0;
    for (double stops = -2; stops <= 4; stops += 0.5) {
        const std::vector<float> texel = {static_cast<float>(light[0]),
                                          static_cast<float>(light[1]),
                                          static_cast<float>(light[2])};
        const double hue = hue_of(linear_shown(texel, std::exp2(stops), curve));
        most = std::max(most, std::fabs(std::remainder(hue - hue_of(light), 360.0)));
    }
    return most;
}

// A sunset stays orange, a sky blue and Mars butterscotch however bright they are: with a curve on each
// channel they turn to lemon and to cyan by 35 degrees and more.
TEST(ToneMapped, KeepsHuesOfAllBrightnesses) {
    constexpr std::array<std::array<double, 3>, 4> kLights = {
        {{1, 0.45, 0.12}, {1, 0.62, 0.3}, {0.24, 0.5, 1}, {1, 0.6, 0.34}}};
    for (const auto& light : kLights) {
        EXPECT_LT(most_turn(light, ToneCurve::film), 10) << light[1];
        EXPECT_GT(most_turn(light, ToneCurve::exponential), 30) << light[1];
    }
}

// Where the picture's greatest channel is not compressed, ratios of light are those of the picture.
TEST(ToneMapped, ShowsTheChromaticityOfABlueSky) {
    const std::array<double, 3> sky = linear_shown({0.12F, 0.25F, 0.5F}, 1, ToneCurve::film);
    EXPECT_NEAR(sky[0] / sky[2], 0.24, 0.05 * 0.24);
    EXPECT_NEAR(sky[1] / sky[2], 0.5, 0.05 * 0.5);
}

// A row of 1000 grey pixels: each light up to its end.
Image2<float> row_of(std::initializer_list<std::pair<int, float>> parts) {
    Image2<float> image(1000, 1, 3);
    int x = 0;
    for (const auto& [end, light] : parts) {
        for (; x < end; ++x) std::fill_n(image.texel(x, 0), 3, light);
    }
    return image;
}

TEST(ExposureFor, BringsThe99thPercentileTo85Percent) {
    const Image2<float> image = row_of({{980, 1}, {992, 4}, {1000, 1e6F}});  // a sun in 8 texels
    for (const ToneCurve curve : kCurves) {
        EXPECT_NEAR(shown(exposure_for(image, curve) * 4, curve), 0.85, 2e-3);
    }
    EXPECT_EQ(exposure_for(texel({0, 0, 0})), 1);
    EXPECT_EQ(exposure_for(Image2<float>()), 1);
}

// A dome in its black surround: the median of what is lit is half a stop above middle grey, however
// bright the light around the sun is, if it is less than a twentieth of the sky.
TEST(SkyExposureFor, BringsTheMedianOfWhatIsLitTo25Percent) {
    const Image2<float> image = row_of({{500, 0}, {980, 2}, {1000, 1e6F}});
    for (const ToneCurve curve : kCurves) {
        EXPECT_NEAR(shown(sky_exposure_for(image, curve) * 2, curve), 0.25, 2e-3);
    }
    // A tenth of the sky is so bright that the median would burn it out.
    const Image2<float> bright = row_of({{500, 0}, {950, 2}, {1000, 50}});
    for (const ToneCurve curve : kCurves) {
        EXPECT_NEAR(shown(sky_exposure_for(bright, curve) * 50, curve), 0.9, 2e-3);
    }
    EXPECT_EQ(sky_exposure_for(texel({0, 0, 0})), 1);
    EXPECT_EQ(sky_exposure_for(Image2<float>()), 1);
}

// Thin cloud against the light: a bright glow in a fiftieth of the picture does not make the rest darker than
// a clear sky is shown.
TEST(CloudExposureFor, LetsTheGlowAroundTheSunBurnOut) {
    const auto fill = [](int bright, float light, float rest) {
        return cloud_exposure_for(row_of({{bright, light}, {1000, rest}}));
    };
    EXPECT_NEAR(shown(fill(20, 50, 2) * 2, ToneCurve::film), 0.25, 2e-3);
    EXPECT_NEAR(shown(fill(20, 3, 2) * 3, ToneCurve::film), 0.9, 2e-3);
    EXPECT_NEAR(shown(fill(20, 5, 0) * 5, ToneCurve::film), 0.9, 2e-3) << "black has no exposure";
}

// What is shown is as a power of the light, whatever the light.
TEST(ExposureFor, LeavesEveningsDarkerThanDays) {
    const Image2<float> image = texel({4, 4, 4});
    for (const auto& chosen : {cloud_exposure_for, sky_exposure_for}) {
        const auto exposure = [&](double share) { return chosen(image, ToneCurve::film, share); };
        EXPECT_EQ(exposure(1.7), exposure(1));
        EXPECT_NEAR(exposure(0.01) / exposure(0.1), exposure(0.1) / exposure(1), 1e-12);
        EXPECT_NEAR(exposure(0.01) / exposure(1), 0.5, 0.002) << "a stop for a hundredth";
        EXPECT_EQ(exposure(0), exposure(kMoonlight));
    }
}

}  // namespace
}  // namespace skybake
