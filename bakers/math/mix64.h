// The steps of splitmix64 (Steele, Lea and Flood 2014, "Fast splittable pseudorandom number generators").
#pragma once

#include <cstdint>

namespace skybake {

inline constexpr std::uint64_t kGolden64 = 0x9e3779b97f4a7c15u;

// The finaliser, which mixes all bits.
inline std::uint64_t mix64(std::uint64_t h) {
    h = (h ^ (h >> 30)) * 0xbf58476d1ce4e5b9u;
    h = (h ^ (h >> 27)) * 0x94d049bb133111ebu;
    return h ^ (h >> 31);
}

}  // namespace skybake
