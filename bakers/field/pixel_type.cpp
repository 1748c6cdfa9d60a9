#include "bakers/field/pixel_type.h"

#include <cmath>
#include <limits>

#include "bakers/math/half_conversion.h"

namespace skybake {

using config::PixelType;

float round_to_pixel_type(double value, PixelType type) {
    const auto single = static_cast<float>(value);
    switch (type) {
        case PixelType::float32:
            return single;
        case PixelType::half:
            return float_of_half(half_of_float(single));
        case PixelType::unorm8:
            return static_cast<float>(std::floor(single * 255.0 + 0.5) / 255);
        case PixelType::unorm16:
            return static_cast<float>(std::floor(single * 65535.0 + 0.5) / 65535);
    }
    return single;
}

PixelRange range_of(PixelType type) {
    constexpr float kLargest = std::numeric_limits<float>::max();
    if (type == PixelType::float32) return {-kLargest, kLargest};
    if (type == PixelType::half) return {-kLargestHalf, kLargestHalf};
    return {0, 1};
}

const char* range_text(PixelType type) {
    if (type == PixelType::float32) return "the finite numbers";
    return type == PixelType::half ? "[-65504, 65504]" : "[0, 1]";
}

int bytes_per_value(PixelType type) {
    switch (type) {
        case PixelType::float32:
            return 4;
        case PixelType::half:
            return 2;
        case PixelType::unorm8:
            return 1;
        case PixelType::unorm16:
            return 2;
    }
    return 4;
}

double smallest_normal(PixelType type) {
    if (type == PixelType::float32) return double{std::numeric_limits<float>::min()};
    return type == PixelType::half ? 0x1p-14 : 0;
}

double rounding_error(PixelType type) {
    switch (type) {
        case PixelType::float32:
            return 0x1p-24;
        case PixelType::half:
            return 0x1p-11;
        case PixelType::unorm8:
            return 0.5 / 255;
        case PixelType::unorm16:
            return 0.5 / 65535;
    }
    return 0;
}

float store(double value, PixelType type, RangeCounts& counts) {
    const float stored = round_to_pixel_type(value, type);
    if (!std::isfinite(stored)) ++counts.above_range;
    if (value != 0 && std::fabs(value) < smallest_normal(type)) ++counts.below_normal;
    return stored;
}

}  // namespace skybake
