#include "bakers/field/rgbe.h"

#include <algorithm>
#include <cmath>

namespace skybake {

void round_to_rgbe(float* values, std::size_t count) {
    for (float* texel = values; count >= 3; texel += 3, count -= 3) {
        const auto [least, largest] = std::minmax({texel[0], texel[1], texel[2]});
        if (!(least >= 0 && largest <= largest_rgbe)) continue;
        int exponent = 0;
        std::frexp(largest, &exponent);
        const auto steps = [&exponent](float value) {
            return std::round(std::ldexp(double{value}, 8 - exponent));
        };
        if (steps(largest) > 255) ++exponent;
        const bool is_dark = largest < 1e-32F;
        for (std::size_t c = 0; c < 3; ++c) {
            texel[c] = is_dark ? 0 : static_cast<float>(std::ldexp(steps(texel[c]), exponent - 8));
        }
    }
}

}  // namespace skybake
