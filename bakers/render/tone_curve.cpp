#include "bakers/render/tone_curve.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/exponential.hpp>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <utility>
#include <vector>

namespace skybake {
namespace {

// The sRGB transfer function of IEC 61966-2-1, for a linear value in [0, 1].
double srgb_of_linear(double linear) {
    if (linear <= 0.0031308) return 12.92 * linear;
    return 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
}

// A table of sRGB in bytes, with fractions, for linear values in [0, 1]. It is linear between entries,
// which is off by 0.005 bytes at most, where the transfer function bends most.
class SrgbTable {
  public:
    SrgbTable() {
        for (int i = 0; i <= steps; ++i) {
            bytes_[static_cast<std::size_t>(i)] =
                static_cast<float>(255 * srgb_of_linear(double{1} * i / steps));
        }
        bytes_[steps + 1] = 255;
    }
    float operator()(float linear) const {
        const float place = linear * steps;
        const auto below = static_cast<std::size_t>(place);
        const float share = place - static_cast<float>(below);
        return bytes_[below] + share * (bytes_[below + 1] - bytes_[below]);
    }

  private:
    static constexpr int steps = 1 << 12;
    std::array<float, steps + 2> bytes_{};
};

// Thresholds of a pixel in [0, 1): a lattice of two irrational steps, the powers of the plastic number
// as shares of 2^32 (Roberts 2018, "The unreasonable effectiveness of quasirandom sequences"). Any few
// pixels side by side have thresholds that are spread evenly. A triangle of it has no jump, whose edge
// would be seen.
float threshold(int x, int y) {
    const std::uint32_t place =
        static_cast<std::uint32_t>(x) * 3242174889U + static_cast<std::uint32_t>(y) * 2447445414U;
    const std::uint32_t folded = (place & 0x80000000U) != 0 ? ~place : place;  // in [0, 2^31)
    return static_cast<float>(folded >> 7) * 0x1p-24F;
}

// Scene-linear light, which is not negative, as shown by each curve.
using Rgb = glm::vec3;

// Returns what the default curve shows of grey light.
float film_of(float light) {
    constexpr float kStraightFrom = 0.22F, kStraightTo = 0.532F, kToe = 1.33F;
    if (light >= kStraightTo) {
        return 1 - (1 - kStraightTo) * std::exp((kStraightTo - light) / (1 - kStraightTo));
    }
    if (light >= kStraightFrom) return light;
    const float place = light / kStraightFrom;
    const float toe = kStraightFrom * std::pow(place, kToe);
    return std::lerp(toe, light, place * place * (3 - 2 * place));
}

Rgb film_of(const Rgb& light) {
    constexpr float kWhitening = 0.15F, kChannelwise = 0.15F;
    const float greatest = std::max({light.r, light.g, light.b});
    if (greatest <= 0) return Rgb(0);
    const float shown = film_of(greatest);
    const float white = 1 - 1 / (1 + kWhitening * (greatest - shown));
    const Rgb kept = shown * glm::mix(light / greatest, Rgb(1), white);
    return glm::mix(kept, Rgb(film_of(light.r), film_of(light.g), film_of(light.b)), kChannelwise);
}

Rgb exponential_of(const Rgb& light) {
    // std::expm1 in float, so that the compiler can vectorise it.
    return {-std::expm1(-light.r), -std::expm1(-light.g), -std::expm1(-light.b)};
}

Rgb aces_of(const Rgb& light) {
    // Columns. From linear sRGB to the working space of the fit, and back.
    constexpr glm::mat3 kIn(0.59719F, 0.07600F, 0.02840F, 0.35458F, 0.90834F, 0.13383F, 0.04823F,
                            0.01566F, 0.83777F);
    constexpr glm::mat3 kOut(1.60475F, -0.10208F, -0.00327F, -0.53108F, 1.10813F, -0.07276F,
                             -0.07367F, -0.00605F, 1.07602F);
    const Rgb v = kIn * light;
    const Rgb fit =
        (v * (v + 0.0245786F) - 0.000090537F) / (v * (0.983729F * v + 0.4329510F) + 0.238081F);
    return kOut * fit;
}

Rgb agx_of(const Rgb& light) {
    constexpr glm::mat3 kInset(0.842479062253094F, 0.0423282422610123F, 0.0423756549057051F,
                               0.0784335999999992F, 0.878468636469772F, 0.0784336F,
                               0.0792237451477643F, 0.0791661274605434F, 0.879142973793104F);
    constexpr glm::mat3 kOutset(1.19687900512017F, -0.0528968517574562F, -0.0529716355144438F,
                                -0.0980208811401368F, 1.15190312990417F, -0.0980434501171241F,
                                -0.0990297440797205F, -0.0989611768448433F, 1.15107367264116F);
    constexpr float kDarkest = -12.47393F;
    constexpr float kBrightest = 4.026069F;
    // The logarithm of 0 is -infinity, which the range takes to its dark end.
    const Rgb stops = glm::log2(kInset * light);
    const Rgb x = glm::clamp((stops - kDarkest) / (kBrightest - kDarkest), 0.0F, 1.0F);
    const Rgb sigmoid =
        ((((((15.5F * x - 40.14F) * x + 31.96F) * x - 6.868F) * x + 0.4298F) * x + 0.1191F) * x) -
        0.00232F;
    // Its result is for a screen with a gamma of 2.2.
    return glm::pow(glm::max(kOutset * sigmoid, 0.0F), Rgb(2.2F));
}

// Beyond this, every curve shows white, and their products stay finite.
constexpr float kBrightest = 1e6F;

// A channel's distance from the greatest one, as a share of that, is 0 in grey and above 1 where no
// screen can show the colour. Distances up to `threshold` stay as they are, and `limit` becomes 1.
struct GamutBorder {
    float threshold, limit;
};
// Red, green and blue: the borders towards cyan, magenta and yellow.
constexpr std::array<GamutBorder, 3> kBorders = {
    {{0.815F, 1.147F}, {0.803F, 1.264F}, {0.880F, 1.312F}}};
constexpr float kBorderPower = 1.2F;

float compressed(float distance, const GamutBorder& border) {
    if (distance <= border.threshold) return distance;
    const float reach = border.limit - border.threshold;
    const float left = std::pow((1 - border.threshold) / reach, -kBorderPower) - 1;
    const float scale = reach / std::pow(left, 1 / kBorderPower);
    const float x = (distance - border.threshold) / scale;
    return border.threshold + scale * x / std::pow(1 + std::pow(x, kBorderPower), 1 / kBorderPower);
}

Rgb in_gamut(const Rgb& light) {
    const float greatest = std::max({light.r, light.g, light.b});
    if (greatest <= 0) return light;
    const Rgb distance = (greatest - light) / greatest;
    return greatest *
           (1.0F - Rgb(compressed(distance.r, kBorders[0]), compressed(distance.g, kBorders[1]),
                       compressed(distance.b, kBorders[2])));
}

Rgb shown_by(ToneCurve curve, const Rgb& exposed) {
    const Rgb within = in_gamut(glm::clamp(exposed, -kBrightest, kBrightest));
    const Rgb light = glm::max(within, 0.0F);
    switch (curve) {
        case ToneCurve::film:
            return film_of(light);
        case ToneCurve::exponential:
            return exponential_of(light);
        case ToneCurve::aces:
            return aces_of(light);
        case ToneCurve::agx:
            break;
    }
    return agx_of(light);
}

// Returns the light that a curve shows as `share` of white. All curves rise with grey light.
double light_shown_as(double share, ToneCurve curve) {
    if (curve == ToneCurve::exponential) return -std::log(1 - share);
    double dark = 0;
    double bright = 64;
    for (int i = 0; i < 60; ++i) {
        const double middle = 0.5 * (dark + bright);
        const bool is_dark = double{shown_by(curve, Rgb(static_cast<float>(middle))).g} < share;
        (is_dark ? dark : bright) = middle;
    }
    return bright;
}

// The luminance of each pixel.
std::vector<double> luminances_of(const Image2<float>& radiance) {
    std::vector<double> luminances;
    const auto channels = static_cast<std::size_t>(std::max(radiance.channels, 1));
    luminances.reserve(radiance.texels.size() / channels);
    for (std::size_t i = 0; i + channels <= radiance.texels.size(); i += channels) {
        luminances.push_back(luminance(radiance.texels.data() + i, radiance.channels));
    }
    return luminances;
}

// Returns the exposure at which the curve shows a quantile of luminances as `share` of white. If the
// quantile is black, any exposure will do, and it is `of_black`.
double exposure_of(std::vector<double> luminances, double quantile, double share, ToneCurve curve,
                   double of_black = 1) {
    if (luminances.empty()) return of_black;
    const auto rank =
        luminances.begin() +
        static_cast<std::ptrdiff_t>(quantile * static_cast<double>(luminances.size() - 1));
    std::nth_element(luminances.begin(), rank, luminances.end());
    return *rank > 0 ? light_shown_as(share, curve) / *rank : of_black;
}

}  // namespace

Picture tone_mapped(const Image2<float>& radiance, double exposure, ToneCurve curve) {
    static const SrgbTable srgb;
    Picture picture(radiance.width, radiance.height);
    const auto scale = static_cast<float>(exposure);
    const bool is_grey = radiance.channels < 3;
    std::uint8_t* pixel = picture.rgb.data();
    for (int y = 0; y < radiance.height; ++y) {
        for (int x = 0; x < radiance.width; ++x) {
            const float* const texel = radiance.texel(x, y);
            const Rgb light = is_grey ? Rgb(texel[0]) : Rgb(texel[0], texel[1], texel[2]);
            const Rgb shown = glm::clamp(shown_by(curve, light * scale), 0.0F, 1.0F);
            const float add = threshold(x, y);
            for (int channel = 0; channel < 3; ++channel) {
                const float byte = srgb(shown[static_cast<Rgb::length_type>(channel)]) + add;
                *pixel++ = static_cast<std::uint8_t>(std::min(byte, 255.0F));
            }
        }
    }
    return picture;
}

const char* tone_curve_name(ToneCurve curve) {
    switch (curve) {
        case ToneCurve::film:
            return "film";
        case ToneCurve::exponential:
            return "1 - exp(-exposure L)";
        case ToneCurve::aces:
            return "ACES (fit by Hill)";
        case ToneCurve::agx:
            break;
    }
    return "AgX (base look)";
}

double luminance(const float* texel, int channels) {
    if (channels < 3) return double{texel[0]};
    return 0.2126 * double{texel[0]} + 0.7152 * double{texel[1]} + 0.0722 * double{texel[2]};
}

double dimming(double daylight_share) {
    return std::pow(std::clamp(daylight_share, kMoonlight, 1.0), kUnadapted);
}

double exposure_by(const ExposureRule& rule, const Image2<float>& radiance, ToneCurve curve) {
    std::vector<double> luminances = luminances_of(radiance);
    if (rule.lit_pixels) std::erase_if(luminances, [](double value) { return value <= 0; });
    double exposure = rule.factor * exposure_of(luminances, rule.quantile, rule.share, curve);
    if (rule.least_median > 0) {
        exposure = std::max(exposure, exposure_of(luminances, 0.5, rule.least_median, curve, 0));
    }
    if (rule.bright_quantile == 0) return exposure;
    return std::min(exposure, exposure_of(std::move(luminances), rule.bright_quantile,
                                          rule.bright_share, curve));
}

}  // namespace skybake
