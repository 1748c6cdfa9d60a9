// Random numbers, and directions distributed as a phase function scatters them.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>

#include "bakers/air/particles/phase_function.h"
#include "bakers/math/vectors.h"

namespace skybake {

// Counter-based random numbers. Each value is a function of its address alone, so that any number
// of threads draws the same values.
//
// The generator is Philox-4x32-10 (Salmon, Moraes, Dror & Shaw 2011, "Parallel random numbers: as
// easy as 1, 2, 3").
using RandomWords = std::array<std::uint32_t, 4>;

inline RandomWords philox_4x32_10(RandomWords counter, std::array<std::uint32_t, 2> key) {
    for (int round = 0; round < 10; ++round) {
        const std::uint64_t a = std::uint64_t{0xD2511F53} * counter[0];
        const std::uint64_t b = std::uint64_t{0xCD9E8D57} * counter[2];
        const auto high = [](std::uint64_t product) {
            return static_cast<std::uint32_t>(product >> 32);
        };
        counter = {high(b) ^ counter[1] ^ key[0], static_cast<std::uint32_t>(b),
                   high(a) ^ counter[3] ^ key[1], static_cast<std::uint32_t>(a)};
        key[0] += 0x9E3779B9;  // the golden ratio's and sqrt(3) - 1's bits
        key[1] += 0xBB67AE85;
    }
    return counter;
}

// The random numbers of one path, dimension by dimension.
class RandomStream {
  public:
    RandomStream(std::uint64_t seed, std::uint32_t ray, std::uint64_t path)
        : key_{static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32)},
          counter_{0, static_cast<std::uint32_t>(path), static_cast<std::uint32_t>(path >> 32),
                   ray} {}

    // Returns a number in (0, 1), symmetric about 1/2: the middle of one of 2^32 equal intervals.
    double next() {
        if (used_ == 4) {
            words_ = philox_4x32_10(counter_, key_);
            ++counter_[0];
            used_ = 0;
        }
        return (words_[used_++] + 0.5) * 0x1p-32;
    }

  private:
    std::array<std::uint32_t, 2> key_;
    RandomWords counter_;
    RandomWords words_{};
    unsigned used_ = 4;
};

// Directions that are distributed as a phase function scatters them.

// Draws a scattering angle. Its cosine nu has the density 2 pi p(nu).
//
// Henyey-Greenstein's distribution is inverted: with s uniform in (-1, 1) and D = 1 + g^2 - 2 g nu,
// D = ((1 - g^2) / (1 + g s))^2, hence
//   1 - nu = (D - (1 - g)^2) / 2 g = (1 - g)^2 (1 - s) (2 + g (1 + s)) / (2 (1 + g s)^2)
//   1 + nu = ((1 + g)^2 - D) / 2 g = (1 + g)^2 (1 + s) (2 - g (1 - s)) / (2 (1 + g s)^2),
// which are sums of terms of one sign for any g. The factor a + b nu^2 of phase_function.h is
// applied by rejection: a <= a + b nu^2 <= a + b, so that at least half of all trials are accepted
// where a = b. Tables are inverted cell by cell (tabulated_phase.h).
ScatteringAngle sample_phase(const PhaseFunction& phase, RandomStream& random);

// Returns the angle to a surface's normal of a direction by Lambert's law, whose density is in
// proportion to the cosine. `share` is uniform in (0, 1).
inline ScatteringAngle lambert_angle(double share) {
    const double cosine = std::sqrt(share);
    return {(1 - share) / (1 + cosine), 1 + cosine};
}

// Returns a direction at that angle to `direction`, with a uniformly distributed azimuth about it.
glm::dvec3 scatter(const glm::dvec3& direction, const ScatteringAngle& cosine,
                   RandomStream& random);

}  // namespace skybake
