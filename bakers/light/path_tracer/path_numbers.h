// The numbers that choose a path: evenly spread points for its first choices, random numbers for
// all others.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "config/sweep/sobol.h"

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

// Sobol's points (config/sweep/sobol.h), whose first 2^k hit each of 2^k equal intervals of every
// dimension once, with nested uniform scrambling (Owen 1995) by hashed bits (Laine & Karras 2011;
// Burley 2020, "Practical hash-based Owen scrambling"). Each point by itself is uniformly
// distributed over scramblings, so means over points stay unbiased. Where a mean's integrand is
// smooth in a few dimensions, its variance falls faster than with the inverse of the number of
// points.
class ScrambledPoints {
  public:
    static constexpr std::size_t kDimensions = config::sobol_dimensions;

    // Scramblings of other seeds, rays or numbers are independent.
    ScrambledPoints(std::uint64_t seed, std::uint32_t ray, std::uint32_t scrambling);

    // Sets `coordinates` to a coordinate of `count` points from `first` on, each in (0, 1): the
    // middle of one of 2^32 equal intervals.
    void coordinates(std::uint32_t first, std::size_t count, std::size_t dimension,
                     double* coordinates) const;

  private:
    std::array<std::uint32_t, kDimensions> seeds_{};
};

// The numbers of many paths that take each number together. Their choices take them in the same order
// in all paths, so that a number has the same meaning in each.
class BatchNumbers {
  public:
    static constexpr std::size_t kPaths = 64;  // at most

    // All numbers are random: `random` has a stream for each path.
    explicit BatchNumbers(std::vector<RandomStream> random) : random_(std::move(random)) {}
    // The first numbers are the coordinates of points from `first` on. `points` must outlive this.
    BatchNumbers(const ScrambledPoints& points, std::uint32_t first,
                 std::vector<RandomStream> random)
        : points_(&points), first_(first), random_(std::move(random)) {}

    std::size_t count() const { return random_.size(); }

    // Goes on to the next number of all paths.
    void go_on() {
        even_ = points_ != nullptr && dimension_ < ScrambledPoints::kDimensions;
        if (even_) points_->coordinates(first_, count(), dimension_++, coordinates_);
    }
    // Returns that number of one path, in (0, 1). It must be asked for once at most, and not at all
    // by a path that has no use for it.
    double of(std::size_t path) { return even_ ? coordinates_[path] : random_[path].next(); }
    // Numbers for choices that not every path has.
    RandomStream& random(std::size_t path) { return random_[path]; }

  private:
    const ScrambledPoints* points_ = nullptr;
    std::uint32_t first_ = 0;
    std::size_t dimension_ = 0;
    bool even_ = false;
    double coordinates_[kPaths] = {};
    std::vector<RandomStream> random_;
};

}  // namespace skybake
