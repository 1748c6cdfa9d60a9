#include "bakers/light/path_tracer/path_numbers.h"

#include <algorithm>
#include <cassert>

namespace skybake {

namespace {

constexpr std::uint32_t reversed(std::uint32_t x) {
    x = (x >> 16) | (x << 16);
    x = ((x & 0x00ff00ff) << 8) | ((x & 0xff00ff00) >> 8);
    x = ((x & 0x0f0f0f0f) << 4) | ((x & 0xf0f0f0f0) >> 4);
    x = ((x & 0x33333333) << 2) | ((x & 0xcccccccc) >> 2);
    return ((x & 0x55555555) << 1) | ((x & 0xaaaaaaaa) >> 1);
}

// Whether a bit changes depends on the bits above it and on the seed alone: arithmetic on reversed
// bits carries nothing down. The factors are those of Vegdahl 2021.
std::uint32_t scrambled(std::uint32_t bits, std::uint32_t seed) {
    std::uint32_t x = reversed(bits);
    x ^= x * 0x3d20adea;
    x += seed;
    x *= (seed >> 16) | 1;
    x ^= x * 0x05526c56;
    x ^= x * 0x53a22864;
    return reversed(x);
}

}  // namespace

ScrambledPoints::ScrambledPoints(std::uint64_t seed, std::uint32_t ray, std::uint32_t scrambling) {
    // No stream of random numbers has this address: its third word is a path's upper half.
    constexpr std::uint32_t kAddress = 0xffffffff;
    for (std::uint32_t i = 0; i < kDimensions / 4; ++i) {
        const RandomWords words = philox_4x32_10(
            {i, scrambling, kAddress, ray},
            {static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32)});
        std::copy(words.begin(), words.end(), seeds_.begin() + 4 * i);
    }
}

double ScrambledPoints::coordinate(std::uint32_t point, std::size_t dimension) const {
    assert(dimension < kDimensions);
    return (scrambled(config::sobol_bits(point, static_cast<int>(dimension)), seeds_[dimension]) +
            0.5) *
           0x1p-32;
}

}  // namespace skybake
