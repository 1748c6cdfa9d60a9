// Random numbers for the places and sizes of towers.
#pragma once

#include <array>
#include <cstdint>

#include "bakers/math/transcendental.h"
#include "bakers/noise/lattice_hash.h"

namespace skybake::cloud {

// Numbers in [0, 1) of 53 bits, one after the other. They depend on the seed and the item alone.
class UnitNumbers {
  public:
    UnitNumbers(std::uint64_t seed, std::uint64_t item)
        : state_(noise::mix64(noise::mix64(seed + noise::kGolden64) ^ (item * noise::kGolden64))) {}

    double next() {
        state_ += noise::kGolden64;
        return static_cast<double>(noise::mix64(state_) >> 11) * 0x1p-53;
    }

  private:
    std::uint64_t state_;
};

inline double between(const std::array<double, 2>& range, double t) {
    return range[0] * (1 - t) + range[1] * t;
}

// The same with logarithms in place of the numbers, which must be above 0.
inline double between_logarithms(const std::array<double, 2>& range, double t) {
    return exponential(between({logarithm(range[0]), logarithm(range[1])}, t));
}

}  // namespace skybake::cloud
