#include "bakers/light/path_tracer/path_numbers.h"

#include <algorithm>
#include <cassert>

namespace skybake {

namespace {

constexpr std::size_t kBits = 32;
using DirectionNumbers = std::array<std::uint32_t, kBits>;

// A row of Joe & Kuo's table: a primitive polynomial over the integers modulo 2 and the first
// direction numbers.
struct SobolRow {
    unsigned degree;
    std::uint32_t polynomial;  // its inner coefficients
    std::array<std::uint32_t, 6> first;
};

constexpr std::array<SobolRow, ScrambledPoints::kDimensions - 1> kRows = {
    {{1, 0, {1}},
     {2, 1, {1, 3}},
     {3, 1, {1, 3, 1}},
     {3, 2, {1, 1, 1}},
     {4, 1, {1, 1, 3, 3}},
     {4, 4, {1, 3, 5, 13}},
     {5, 2, {1, 1, 5, 5, 17}},
     {5, 4, {1, 1, 5, 5, 5}},
     {5, 7, {1, 1, 7, 11, 19}},
     {5, 11, {1, 1, 5, 1, 1}},
     {5, 13, {1, 1, 1, 3, 11}},
     {5, 14, {1, 3, 5, 5, 31}},
     {6, 1, {1, 3, 3, 9, 7, 49}},
     {6, 13, {1, 1, 1, 15, 21, 21}},
     {6, 16, {1, 3, 1, 13, 27, 49}}}};

constexpr DirectionNumbers direction_numbers(const SobolRow& row) {
    DirectionNumbers numbers{};
    for (std::size_t i = 0; i < row.degree; ++i) numbers[i] = row.first[i] << (kBits - 1 - i);
    for (std::size_t i = row.degree; i < kBits; ++i) {
        numbers[i] = numbers[i - row.degree] ^ (numbers[i - row.degree] >> row.degree);
        for (std::size_t k = 1; k < row.degree; ++k) {
            if ((row.polynomial >> (row.degree - 1 - k)) & 1) numbers[i] ^= numbers[i - k];
        }
    }
    return numbers;
}

constexpr std::array<DirectionNumbers, ScrambledPoints::kDimensions> all_direction_numbers() {
    std::array<DirectionNumbers, ScrambledPoints::kDimensions> all{};
    for (std::size_t i = 0; i < kBits; ++i) all[0][i] = std::uint32_t{1} << (kBits - 1 - i);
    for (std::size_t d = 1; d < all.size(); ++d) all[d] = direction_numbers(kRows[d - 1]);
    return all;
}

constexpr auto kDirectionNumbers = all_direction_numbers();

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
    const auto words = [&](std::uint32_t number) {
        return philox_4x32_10(
            {number, scrambling, kAddress, ray},
            {static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32)});
    };
    for (std::uint32_t i = 0; i < kDimensions / 4; ++i) {
        const RandomWords four = words(i);
        std::copy(four.begin(), four.end(), seeds_.begin() + 4 * i);
    }
    any_ = words(kDimensions / 4).front();
}

double ScrambledPoints::coordinate(std::uint32_t point, std::size_t dimension) const {
    assert(dimension < kDimensions);
    return (scrambled(sobol_bits(point, dimension), seeds_[dimension]) + 0.5) * 0x1p-32;
}

std::uint32_t sobol_bits(std::uint32_t point, std::size_t dimension) {
    const DirectionNumbers& numbers = kDirectionNumbers[dimension];
    std::uint32_t bits = 0;
    for (std::size_t i = 0; point != 0; ++i, point >>= 1) {
        bits ^= numbers[i] & (0 - (point & 1));  // no branch: these bits are hard to predict
    }
    return bits;
}

}  // namespace skybake
