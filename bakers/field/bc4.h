// BC4: blocks of 4 x 4 texels of one channel in [0, 1], each in 8 bytes: two end points of 8 bits and
// an index of 3 bits for each texel. BC5 is two such blocks, one for each channel.
//
// If the first end point is the larger one, the texel values are eight, evenly from one end point to
// the other. If it is not, they are six from one to the other, and 0 and 1.
//
// Source: Microsoft, "Block Compression (Direct3D 10)"; Khronos Data Format Specification, 1.3,
// section 19, "RGTC".
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace skybake {

inline constexpr std::size_t bc4_bytes = 8;

// Texels of one channel, in rows that are `pitch` texels apart. A row of blocks is four of them. In
// memory, bc4_padding texels follow the last row.
struct TexelPlane {
    const float* texels = nullptr;
    std::size_t pitch = 0;
    std::size_t blocks_x = 0;
    std::size_t blocks_y = 0;
};
inline constexpr std::size_t bc4_padding = 64;

// Encodes a plane: block i, counted along rows, goes to out + i * stride. Values must be in [0, 1].
//
// Minimises the sum of squared differences of each block. Twelve starts give indices, to which end
// points are fitted by least squares; the best of them are rounded, fitted once more, and their
// neighbours tried. Then the other kind of block is tried where it could be better. The RMS error of
// volumes is less than 2 % above that of an exhaustive search (tests/field/bc4_test.cpp).
void encode_bc4(const TexelPlane& plane, std::uint8_t* out, std::size_t stride);

// Returns the texels of a block, row after row: the float nearest to the value that the end points
// and the index define.
std::array<float, 16> decode_bc4(const std::uint8_t* block);

}  // namespace skybake
