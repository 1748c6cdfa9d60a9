// Values in equal steps between the least and the largest of a block, as leaves of NanoVDB grids of
// type Fp8 and Fp16 hold them.
#pragma once

#include <cstddef>
#include <cstdint>

namespace skybake {

// The value of code c is minimum + c * quantum, in float, where the product is rounded. A GPU that
// does not round the product gives a value that differs in the last place.
struct LeafCodes {
    float minimum = 0;
    float quantum = 0;  // 0 if all values are equal

    float value(std::uint16_t code) const { return static_cast<float>(code) * quantum + minimum; }
};

// Writes the code of each value, 0 to 2^bits - 1, to `codes`. The least value has code 0 and is held
// exactly; the others are rounded to nearest, half upwards. `bits` is 8 or 16; `values` are finite
// and their range fits a float.
LeafCodes quantize_leaf(const float* values, std::size_t count, int bits, std::uint16_t* codes);

}  // namespace skybake
