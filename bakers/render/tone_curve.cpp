#include "bakers/render/tone_curve.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

namespace skybake {
namespace {

// The sRGB transfer function of IEC 61966-2-1, for a linear value in [0, 1].
double srgb_of_linear(double linear) {
    if (linear <= 0.0031308) return 12.92 * linear;
    return 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
}

// A table of sRGB bytes for linear values in [0, 1]. Its steps are so small that one byte spans 5
// of them even near black, where the slope of the transfer function is greatest, 12.92.
class SrgbTable {
  public:
    SrgbTable() {
        for (int i = 0; i <= steps; ++i) {
            bytes_[static_cast<std::size_t>(i)] =
                static_cast<std::uint8_t>(std::lround(255 * srgb_of_linear(double{1} * i / steps)));
        }
    }
    std::uint8_t operator()(double linear) const {
        return bytes_[static_cast<std::size_t>(linear * steps + 0.5)];
    }

  private:
    static constexpr int steps = 1 << 14;
    std::array<std::uint8_t, steps + 1> bytes_{};
};

// The tone curve in float, so that the compiler can vectorise the exponential.
float curve(float exposed) { return exposed > 0 ? -std::expm1(-exposed) : 0.0F; }

// Returns the luminance by Rec. 709, whose primaries are those of sRGB.
double luminance(const float* texel, int channels) {
    if (channels < 3) return double{texel[0]};
    return 0.2126 * double{texel[0]} + 0.7152 * double{texel[1]} + 0.0722 * double{texel[2]};
}

}  // namespace

Picture tone_mapped(const Image2<float>& radiance, double exposure) {
    static const SrgbTable srgb;
    Picture picture(radiance.width, radiance.height);
    const auto scale = static_cast<float>(exposure);
    for (int y = 0; y < radiance.height; ++y) {
        for (int x = 0; x < radiance.width; ++x) {
            const float* const texel = radiance.texel(x, y);
            std::uint8_t* const pixel =
                picture.rgb.data() +
                3 * (radiance.offset(x, y) / static_cast<std::size_t>(radiance.channels));
            for (int channel = 0; channel < 3; ++channel) {
                const float value = texel[radiance.channels < 3 ? 0 : channel];
                pixel[channel] = srgb(double{curve(value * scale)});
            }
        }
    }
    return picture;
}

const char* tone_curve_name() { return "1 - exp(-exposure L)"; }

double exposure_for(const Image2<float>& radiance) {
    std::vector<double> luminances;
    const auto channels = static_cast<std::size_t>(std::max(radiance.channels, 1));
    luminances.reserve(radiance.texels.size() / channels);
    for (std::size_t i = 0; i + channels <= radiance.texels.size(); i += channels) {
        luminances.push_back(luminance(radiance.texels.data() + i, radiance.channels));
    }
    if (luminances.empty()) return 1;
    const auto rank = luminances.begin() + static_cast<std::ptrdiff_t>(
                                               0.99 * static_cast<double>(luminances.size() - 1));
    std::nth_element(luminances.begin(), rank, luminances.end());
    // Solves 1 - exp(-exposure L) = 0.85. If the percentile is black, any exposure will do.
    return *rank > 0 ? -std::log(0.15) / *rank : 1;
}

}  // namespace skybake
