// BC6H, unsigned: blocks of 4 x 4 texels of three halves that are not negative, each in 16 bytes.
//
// Blocks use the modes 11 to 14 of the format: one pair of end points for each channel, of 10, 11, 12
// or 16 bits, where the second end point of the latter three is stored as a difference of 9, 8 or 4
// bits; and 4 bits for each texel, which say where it lies between them. The modes 1 to 10, which
// part a block in two regions, are not used.
//
// Source: Microsoft, "BC6H Format"; Khronos Data Format Specification, 1.3, section 20, "BPTC".
#pragma once

#include <array>
#include <cstdint>

#include "bakers/field/bc4.h"

namespace skybake {

// Encodes planes of equal size: block i, counted along rows, goes to out + 16 i. Values must be in
// [0, 65504].
//
// Minimises the sum of squared differences of the halves' bit patterns, which are differences of
// logarithms within a power of two: relative errors of dark and bright texels count alike.
void encode_bc6h(const std::array<TexelPlane, 3>& planes, std::uint8_t* out);

// Returns the texels of a block for each channel. Blocks of other modes are 0.
std::array<std::array<float, 16>, 3> decode_bc6h(const std::uint8_t* block);

}  // namespace skybake
