#include "bakers/field/dither.h"

#include <cmath>
#include <cstdint>

#include "bakers/field/pixel_type.h"
#include "config/sections/files.h"

namespace skybake {
namespace {

// The share of a step that is added before rounding down, in (0, 1): one of 128 that are equally
// frequent. The first and the last are far enough from 0 and 1 for the float nearest to a step.
double offset_of(const std::array<int, 2>& texel, int channel) {
    constexpr double two_to_32 = 4294967296.0;
    constexpr auto along_x = static_cast<std::uint32_t>(0.06711056 * two_to_32);
    constexpr auto along_y = static_cast<std::uint32_t>(0.00583715 * two_to_32);
    constexpr auto factor = static_cast<std::uint64_t>(52.9829189 * (1 << 24));
    constexpr std::uint32_t golden = 2654435769U;  // channels are apart by this share
    const std::uint32_t slope = static_cast<std::uint32_t>(texel[0]) * along_x +
                                static_cast<std::uint32_t>(texel[1]) * along_y;
    const auto noise = static_cast<std::uint32_t>(slope * factor >> 24) +
                       static_cast<std::uint32_t>(channel) * golden;
    return ((noise >> 25) + 0.5) / 128;
}

}  // namespace

TexelRounding::TexelRounding(const config::AssetFiles& files)
    : type(files.pixel_type), dithers(files.dither) {}

float round_texel(double value, TexelRounding rounding, std::array<int, 2> texel, int channel) {
    const bool has_steps = config::unorm_types.contains(rounding.type);
    if (!rounding.dithers || !has_steps || !(value >= 0 && value <= 1)) {
        return round_to_pixel_type(value, rounding.type);
    }
    const double steps = 0.5 / rounding_error(rounding.type);
    return static_cast<float>(std::floor(value * steps + offset_of(texel, channel)) / steps);
}

}  // namespace skybake
