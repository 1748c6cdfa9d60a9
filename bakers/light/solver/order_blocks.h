// Moments in the order in which transport reads them: blocks of four azimuthal orders of one degree,
// of four channel slots each, as one vector of 16 numbers or several narrower ones.
//
// Blocks are stored by ascending quad of orders (m = 4 q to 4 q + 3), and for each quad by ascending
// l from 4 q on. Orders above l are 0, and add nothing.
//
// Numbers are floats for light of all orders up to degree 8, and for the last orders of a higher
// degree (peaked_light.h): light is a sum of what many points send, each of which is off by 6e-4 for
// the grid's sake (solve_light.h), so that rounding to 6e-8 at each point does not show; it changes
// skies of haze and fog by less than 1e-6. They are doubles where all orders of a higher degree are
// summed.
#pragma once

#include <cstddef>
#include <vector>

#include "bakers/light/solver/solved_light.h"

namespace skybake {

inline constexpr std::size_t kQuad = 4;
inline constexpr std::size_t kBlock = kQuad * kChannelSlots;  // numbers

// On cache lines of its own.
template <class Number>
struct alignas(64) MomentBlock {
    Number values[kBlock] = {};  // [m * kChannelSlots + channel], m from the block's first order on
};

inline std::size_t quad_count(int degree) { return static_cast<std::size_t>(degree) / kQuad + 1; }
inline std::size_t block_count(int degree) {
    std::size_t count = 0;
    for (int least = 0; least <= degree; least += static_cast<int>(kQuad)) {
        count += static_cast<std::size_t>(degree + 1 - least);
    }
    return count;
}

// Calls visit(block, l, m of the block's first order) for all blocks of a degree, in their order.
template <class Visit>
void for_each_block(int degree, const Visit& visit) {
    std::size_t block = 0;
    for (int least = 0; least <= degree; least += static_cast<int>(kQuad)) {
        for (int l = least; l <= degree; ++l) visit(block++, l, least);
    }
}

// Writes moments, kChannelSlots values each and by moment_index, in blocks.
template <class Number>
void write_blocks(int degree, const double* moments, MomentBlock<Number>* blocks);

// The light of a LightField in blocks.
template <class Number>
struct BlockedLight {
    int suns = 0;
    int degree = 0;
    std::vector<MomentBlock<Number>> moments;         // [(level * suns + sun) * sun_size() + block]
    std::vector<MomentBlock<Number>> sky_irradiance;  // of each sun, as order 0

    BlockedLight(const LightField& light, int threads);
    std::size_t sun_size() const { return block_count(degree); }
    std::size_t level_size() const { return static_cast<std::size_t>(suns) * sun_size(); }
    const MomentBlock<Number>* at(int level) const {
        return moments.data() + static_cast<std::size_t>(level) * level_size();
    }
};

}  // namespace skybake
