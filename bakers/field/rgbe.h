// RGBE, the texels of Radiance pictures: three numbers that are not negative, each 8 bits, with the
// exponent of the power of two above the largest of them. It rounds to half a step, at most 0.4 % of the
// largest. Numbers are steps of 2^(exponent - 8), without the half step that Radiance's own programs add,
// as most readers have it; below 1e-32 they are 0.
//
// Source: Ward, "Real Pixels", Graphics Gems II, 1991.
#pragma once

#include <cstddef>

namespace skybake {

inline constexpr float largest_rgbe = 0x1.FEp126F;  // 255 steps of 2^119

// Rounds interleaved texels, `count` numbers. A texel that is not in [0, largest_rgbe] stays as it is.
void round_to_rgbe(float* values, std::size_t count);

}  // namespace skybake
