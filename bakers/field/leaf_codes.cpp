#include "bakers/field/leaf_codes.h"

#include <algorithm>

namespace skybake {

LeafCodes quantize_leaf(const float* values, std::size_t count, int bits, std::uint16_t* codes) {
    const auto [least, largest] = std::minmax_element(values, values + count);
    const double steps = (1 << bits) - 1;
    const double range = double{*largest} - double{*least};
    LeafCodes leaf{*least, static_cast<float>(range / steps)};
    if (leaf.quantum == 0) {
        std::fill_n(codes, count, std::uint16_t{0});
        return leaf;
    }
    // The quantum is rounded, so codes are counted in units of what readers multiply with.
    const double scale = 1 / double{leaf.quantum};
    for (std::size_t i = 0; i < count; ++i) {
        const double code = (double{values[i]} - double{leaf.minimum}) * scale + 0.5;
        codes[i] = static_cast<std::uint16_t>(std::min(code, steps));
    }
    return leaf;
}

}  // namespace skybake
