// Conversion between float and half (IEEE 754 binary16) by integer arithmetic without branches, so
// that compilers vectorise loops over it. The results equal Imath's half in every bit, except for
// the bits of a NaN.
#pragma once

#include <bit>
#include <cstdint>

namespace skybake {

inline constexpr float kLargestHalf = 65504.0F;

// Rounds to nearest, ties to even. Values from 65520 on become infinity; a NaN becomes a quiet NaN.
inline std::uint16_t half_of_float(float value) {
    const auto bits = std::bit_cast<std::int32_t>(value);
    const std::int32_t magnitude = bits & 0x7fffffff;
    const std::int32_t sign =
        static_cast<std::int32_t>(static_cast<std::uint32_t>(bits) >> 16) & 0x8000;
    // Normal halves: the exponent's bias goes from 127 to 15, and 13 bits are rounded away. A carry
    // out of the mantissa raises the exponent, as it should.
    const std::int32_t rebiased = magnitude - (112 << 23);
    const std::int32_t normal = (rebiased + 0xfff + ((rebiased >> 13) & 1)) >> 13;
    // Halves below 2^-14 are multiples of 2^-24, and so are floats in [0.5, 1): the sum rounds.
    const std::int32_t denormal =
        std::bit_cast<std::int32_t>(std::bit_cast<float>(magnitude) + 0.5F) - 0x3f000000;
    const std::int32_t finite = magnitude < 0x38800000 ? denormal : normal;
    const std::int32_t bounded = magnitude >= 0x47800000 ? 0x7c00 : finite;
    const std::int32_t result = magnitude > 0x7f800000 ? 0x7e00 : bounded;
    return static_cast<std::uint16_t>(result | sign);
}

// Converts exactly.
inline float float_of_half(std::uint16_t half) {
    const std::uint32_t magnitude = half & 0x7fffU;
    const std::uint32_t sign = (half & 0x8000U) << 16;
    // The exponent's bias goes from 15 to 127. An exponent of 31, which marks infinity and NaN,
    // becomes 255.
    const std::uint32_t normal =
        (magnitude << 13) + (magnitude >= 0x7c00U ? 224U << 23 : 112U << 23);
    // The mantissa of a denormal counts units of 2^-24.
    const std::uint32_t denormal = std::bit_cast<std::uint32_t>(
        static_cast<float>(static_cast<std::int32_t>(magnitude)) * 0x1p-24F);
    return std::bit_cast<float>((magnitude < 0x400U ? denormal : normal) | sign);
}

}  // namespace skybake
