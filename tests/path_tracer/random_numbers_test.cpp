#include <gtest/gtest.h>

#include <boost/random/sobol.hpp>
#include <set>
#include <vector>

#include "bakers/light/path_tracer/path_numbers.h"
#include "tests/path_tracer/single_path.h"

namespace skybake {
namespace {

using test::PathNumbers;

// Random123's kat_vectors for philox4x32, 10 rounds.
TEST(RandomNumbers, ArePhilox) {
    EXPECT_EQ(philox_4x32_10({0, 0, 0, 0}, {0, 0}),
              (RandomWords{0x6627e8d5, 0xe169c58d, 0xbc57ac4c, 0x9b00dbd8}));
    EXPECT_EQ(philox_4x32_10({~0U, ~0U, ~0U, ~0U}, {~0U, ~0U}),
              (RandomWords{0x408f276d, 0x41c83b0e, 0xa20bc7c6, 0x6d5451fd}));
    EXPECT_EQ(
        philox_4x32_10({0x243f6a88, 0x85a308d3, 0x13198a2e, 0x03707344}, {0xa4093822, 0x299f31d0}),
        (RandomWords{0xd16cfe09, 0x94fdcceb, 0x5001e420, 0x24126ea1}));
}

// Word by word, across blocks of four, and each part of the address in its place.
TEST(RandomNumbers, StreamIsAFunctionOfItsAddress) {
    const std::uint64_t seed = 0x0123456789abcdef;
    const std::uint64_t path = 0xfedcba9876543210;
    RandomStream stream(seed, 77, path);
    for (std::uint32_t block = 0; block < 3; ++block) {
        const RandomWords words =
            philox_4x32_10({block, 0x76543210, 0xfedcba98, 77}, {0x89abcdef, 0x01234567});
        for (const std::uint32_t word : words) {
            EXPECT_EQ(stream.next(), (word + 0.5) / 4294967296.0);
        }
    }
}

// Another program's points, which come in the order of Gray's code: the same points, in groups of
// 2^k.
TEST(ScrambledPoints, BeginAsSobolPoints) {
    constexpr std::size_t kDimensions = ScrambledPoints::kDimensions;
    boost::random::sobol others(kDimensions);
    constexpr std::uint32_t kCount = 1024;
    std::set<std::vector<std::uint32_t>> expected = {std::vector<std::uint32_t>(kDimensions, 0)};
    for (std::uint32_t i = 1; i < kCount; ++i) {
        std::vector<std::uint32_t> point;
        for (std::size_t d = 0; d < kDimensions; ++d) {
            point.push_back(static_cast<std::uint32_t>(others() >> 32));
        }
        expected.insert(point);
    }
    std::set<std::vector<std::uint32_t>> points;
    for (std::uint32_t i = 0; i < kCount; ++i) {
        std::vector<std::uint32_t> point;
        for (std::size_t d = 0; d < kDimensions; ++d)
            point.push_back(config::sobol_bits(i, static_cast<int>(d)));
        points.insert(point);
    }
    EXPECT_EQ(points, expected);
}

// Scrambling keeps what makes the points even: each of 2^k equal intervals of any dimension, and
// each of the boxes of 2^-i by 2^-(k - i) in the first two, holds one of any 2^k points that follow
// a multiple of 2^k.
TEST(ScrambledPoints, HitEveryIntervalOnce) {
    constexpr std::uint32_t kBits = 8;
    constexpr std::uint32_t kCount = 1U << kBits;
    for (std::uint32_t scrambling = 0; scrambling < 8; ++scrambling) {
        const ScrambledPoints points(7, 3, scrambling);
        const std::uint32_t first = scrambling * kCount;
        double rows[ScrambledPoints::kDimensions][kCount];
        for (std::size_t d = 0; d < ScrambledPoints::kDimensions; ++d) {
            points.coordinates(first, kCount, d, rows[d]);
            std::set<int> hit;
            for (const double x : rows[d]) hit.insert(static_cast<int>(x * kCount));
            EXPECT_EQ(hit.size(), kCount) << "dimension " << d;
        }
        for (std::uint32_t across = 0; across <= kBits; ++across) {
            std::set<std::pair<int, int>> hit;
            for (std::uint32_t i = 0; i < kCount; ++i) {
                hit.insert({static_cast<int>(rows[0][i] * (1U << across)),
                            static_cast<int>(rows[1][i] * (1U << (kBits - across)))});
            }
            EXPECT_EQ(hit.size(), kCount) << "boxes 2^-" << across << " wide";
        }
    }
}

// One point by itself is anywhere, in two dimensions at once: 4096 scramblings in 8 x 8 boxes, of
// which chi-square has 63 degrees of freedom.
TEST(ScrambledPoints, AreUniformOverScramblings) {
    for (const std::uint32_t point : {0U, 1U, 77U}) {
        for (std::size_t d = 0; d < ScrambledPoints::kDimensions; ++d) {
            std::vector<int> counts(64, 0);
            for (std::uint32_t scrambling = 0; scrambling < 4096; ++scrambling) {
                const ScrambledPoints points(scrambling % 5, 11, scrambling);
                double x = 0, y = 0;
                points.coordinates(point, 1, d, &x);
                points.coordinates(point, 1, (d + 1) % ScrambledPoints::kDimensions, &y);
                ++counts[8 * static_cast<std::size_t>(8 * x) + static_cast<std::size_t>(8 * y)];
            }
            double chi_square = 0;
            for (const int count : counts) chi_square += (count - 64.0) * (count - 64.0) / 64;
            EXPECT_LT(chi_square, 125) << "point " << point << ", dimension " << d;
            EXPECT_GT(chi_square, 25) << "point " << point << ", dimension " << d;
        }
    }
}

// The points serve this purpose: a smooth mean over six dimensions is nearer than by random numbers.
TEST(ScrambledPoints, FindSmoothMeansBetterThanRandomNumbers) {
    constexpr std::uint32_t kCount = 256;
    const auto smooth = [](PathNumbers& numbers) {
        double product = 1;
        for (int d = 0; d < 6; ++d) product *= 1 + (numbers.next() - 0.5) / (d + 1);
        return product;
    };
    double of_points = 0;
    double of_random = 0;
    for (std::uint32_t run = 0; run < 64; ++run) {
        const ScrambledPoints points(1, 2, run);
        double mean = 0;
        double random_mean = 0;
        for (std::uint32_t i = 0; i < kCount; ++i) {
            const RandomStream random(1, run, i);
            PathNumbers even(points, i, random);
            PathNumbers plain(random);
            mean += smooth(even) / kCount;
            random_mean += smooth(plain) / kCount;
        }
        of_points += (mean - 1) * (mean - 1);
        of_random += (random_mean - 1) * (random_mean - 1);
    }
    EXPECT_LT(of_points, of_random / 50);
}

// A number left out is a dimension left out, and numbers after the last dimension are random.
TEST(PathNumbers, FollowTheDimensions) {
    const ScrambledPoints points(3, 4, 5);
    const RandomStream random(3, 4, 6);
    PathNumbers numbers(points, 9, random);
    for (std::size_t d = 0; d < ScrambledPoints::kDimensions; ++d) {
        double expected = 0;
        points.coordinates(9, 1, d, &expected);
        if (d == 1)
            numbers.go_on();
        else
            EXPECT_EQ(numbers.next(), expected) << d;
    }
    numbers.go_on();
    RandomStream same = random;
    EXPECT_EQ(numbers.next(), same.next());
    EXPECT_EQ(numbers.random(0).next(), same.next());
}

}  // namespace
}  // namespace skybake
