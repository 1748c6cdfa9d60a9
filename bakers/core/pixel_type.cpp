#include "bakers/core/pixel_type.h"

#include <Imath/half.h>

#include <cmath>
#include <limits>

namespace skybake {

using config::PixelType;

float round_to_pixel_type(double value, PixelType type) {
    const auto single = static_cast<float>(value);
    return type == PixelType::float32 ? single : static_cast<float>(half(single));
}

double smallest_normal(PixelType type) {
    return type == PixelType::half ? 0x1p-14 : double{std::numeric_limits<float>::min()};
}

double rounding_error(PixelType type) { return type == PixelType::half ? 0x1p-11 : 0x1p-24; }

float store(double value, PixelType type, RangeCounts& counts) {
    const float stored = round_to_pixel_type(value, type);
    if (!std::isfinite(stored)) ++counts.above_range;
    if (value != 0 && std::fabs(value) < smallest_normal(type)) ++counts.below_normal;
    return stored;
}

}  // namespace skybake
