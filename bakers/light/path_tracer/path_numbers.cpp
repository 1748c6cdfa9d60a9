#include "bakers/light/path_tracer/path_numbers.h"

#include <algorithm>
#include <cassert>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "bakers/light/path_tracer/path_numbers.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace skybake::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using Words = hn::CappedTag<std::uint32_t, 16>;
using Word = hn::Vec<Words>;

HWY_INLINE Word mask(std::uint32_t bits) { return hn::Set(Words(), bits); }

HWY_INLINE Word reversed(Word x) {
    x = hn::Or(hn::ShiftRight<16>(x), hn::ShiftLeft<16>(x));
    const auto swapped = [&]<int kBy>(std::uint32_t low) {
        return hn::Or(hn::ShiftLeft<kBy>(hn::And(x, mask(low))),
                      hn::And(hn::ShiftRight<kBy>(x), mask(low)));
    };
    x = swapped.template operator()<8>(0x00ff00ff);
    x = swapped.template operator()<4>(0x0f0f0f0f);
    x = swapped.template operator()<2>(0x33333333);
    return swapped.template operator()<1>(0x55555555);
}

// Whether a bit changes depends on the bits above it and on the seed alone: arithmetic on reversed
// bits carries nothing down. The factors are those of Vegdahl 2021.
HWY_INLINE Word scrambled(Word bits, std::uint32_t seed) {
    Word x = reversed(bits);
    x = hn::Xor(x, hn::Mul(x, mask(0x3d20adea)));
    x = hn::Add(x, mask(seed));
    x = hn::Mul(x, mask((seed >> 16) | 1));
    x = hn::Xor(x, hn::Mul(x, mask(0x05526c56)));
    x = hn::Xor(x, hn::Mul(x, mask(0x53a22864)));
    return reversed(x);
}

// Sobol's points are sums without carry of one direction for each bit of their number. Sets `count`
// values, and those after them that fill the last vector.
void ScrambledRow(std::uint32_t first, std::size_t count, std::size_t dimension, std::uint32_t seed,
                  std::uint32_t* bits) {
    const auto last = first + static_cast<std::uint32_t>(count - 1);
    std::uint32_t directions[32];
    int used = 0;
    for (; used < 32 && last >> used != 0; ++used) {
        directions[used] = config::sobol_direction(used, static_cast<int>(dimension));
    }
    for (std::size_t i = 0; i < count; i += hn::Lanes(Words())) {
        const Word point = hn::Iota(Words(), first + static_cast<std::uint32_t>(i));
        Word x = hn::Zero(Words());
        for (int bit = 0; bit < used; ++bit) {
            const auto has_bit = hn::TestBit(point, mask(std::uint32_t{1} << bit));
            x = hn::Xor(x, hn::IfThenElseZero(has_bit, mask(directions[bit])));
        }
        hn::StoreU(scrambled(x, seed), Words(), bits + i);
    }
}

}  // namespace skybake::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace skybake {

HWY_EXPORT(ScrambledRow);

ScrambledPoints::ScrambledPoints(std::uint64_t seed, std::uint32_t ray, std::uint32_t scrambling) {
    // No stream of random numbers has this address: its third word is a path's upper half.
    constexpr std::uint32_t kAddress = 0xffffffff;
    for (std::uint32_t i = 0; i < kDimensions / 4; ++i) {
        const RandomWords words = philox_4x32_10(
            {i, scrambling, kAddress, ray},
            {static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32)});
        std::ranges::copy(words, seeds_.begin() + 4 * i);
    }
}

void ScrambledPoints::coordinates(std::uint32_t first, std::size_t count, std::size_t dimension,
                                  double* coordinates) const {
    assert(dimension < kDimensions && count > 0);
    constexpr std::size_t kRow = 64;
    std::uint32_t bits[kRow];
    for (std::size_t i = 0; i < count; i += kRow) {
        const std::size_t used = std::min(kRow, count - i);
        HWY_DYNAMIC_DISPATCH(ScrambledRow)
        (first + static_cast<std::uint32_t>(i), used, dimension, seeds_[dimension], bits);
        for (std::size_t k = 0; k < used; ++k) coordinates[i + k] = (bits[k] + 0.5) * 0x1p-32;
    }
}

}  // namespace skybake
#endif  // HWY_ONCE
