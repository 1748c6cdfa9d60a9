// Floats that are hard to round to halves.
#pragma once

#include <bit>
#include <cstdint>

namespace skybake::testing {

// Calls a function of the bits of floats: of every `stride`th value of the upper 19 bits, with every
// pattern below them that decides how normal halves round; and of the floats about the middle between
// each two neighbouring denormals, which round at other bits.
template <class Visit>
void for_each_hard_float(std::uint32_t stride, const Visit& visit) {
    for (std::uint32_t upper = 0; upper < 1U << 19; upper += stride) {
        for (const std::uint32_t lower : {0x0U, 0x1U, 0xfffU, 0x1000U, 0x1001U, 0x1fffU}) {
            visit(upper << 13 | lower);
        }
    }
    for (std::uint32_t i = 0; i <= 2 * 1024; ++i) {
        const auto middle = std::bit_cast<std::uint32_t>(static_cast<float>(i) * 0x1p-25F);
        for (const std::uint32_t bits : {middle == 0 ? 0 : middle - 1, middle, middle + 1}) {
            visit(bits);
            visit(bits | 0x80000000U);
        }
    }
}

}  // namespace skybake::testing
