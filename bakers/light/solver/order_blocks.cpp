#include "bakers/light/solver/order_blocks.h"

#include <algorithm>

#include "bakers/math/parallel.h"

namespace skybake {

template <class Number>
void write_blocks(int degree, const double* moments, MomentBlock<Number>* blocks) {
    for_each_block(degree, [&](std::size_t block, int l, int least) {
        blocks[block] = {};
        Number* to = blocks[block].values;
        const int orders = std::min(l - least + 1, static_cast<int>(kQuad));
        const double* from =
            moments + static_cast<std::size_t>(moment_index(l, least)) * kChannelSlots;
        for (std::size_t i = 0; i < static_cast<std::size_t>(orders) * kChannelSlots; ++i) {
            to[i] = static_cast<Number>(from[i]);
        }
    });
}

template <class Number>
BlockedLight<Number>::BlockedLight(const LightField& light, int threads)
    : suns(light.suns),
      degree(light.degree),
      moments(static_cast<std::size_t>(light.levels) * level_size()),
      sky_irradiance(static_cast<std::size_t>(light.suns)) {
    parallel_for(light.levels, threads, [&](int level) {
        for (int sun = 0; sun < suns; ++sun) {
            write_blocks(degree, light.at(level, sun),
                         moments.data() + static_cast<std::size_t>(level) * level_size() +
                             static_cast<std::size_t>(sun) * sun_size());
        }
    });
    for (int sun = 0; sun < suns; ++sun) {
        write_blocks(0, light.sky_irradiance.data() + static_cast<std::size_t>(sun) * kChannelSlots,
                     &sky_irradiance[static_cast<std::size_t>(sun)]);
    }
}

template void write_blocks(int degree, const double* moments, MomentBlock<float>* blocks);
template void write_blocks(int degree, const double* moments, MomentBlock<double>* blocks);
template struct BlockedLight<float>;
template struct BlockedLight<double>;

}  // namespace skybake
