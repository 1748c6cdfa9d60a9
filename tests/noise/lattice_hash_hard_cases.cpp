// The lattice's random numbers: every figure is of a fixed set of lattice points, and in units of
// the standard deviation that independent fair bits would have.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <set>
#include <vector>

#include "bakers/noise/lattice_hash.h"
#include "tests/noise/noises.h"
#include "tests/support/hard_case.h"

namespace skybake::noise {
namespace {

using test::hold;

// The largest of some thousand normal deviates is about 4; one in 10^5 such sets reaches 6.
constexpr double kLargestOfThousands = 6;
constexpr double kLargestOfAFew = 5;

// --- Avalanche ----------------------------------------------------------------------------------

// The numbers that a lattice point's hash is made of.
struct Input {
    std::uint64_t noise_seed = 0;
    std::uint64_t channel_seed = 0;
    std::uint32_t x = 0, y = 0, z = 0;
};

// The three 24-bit offsets of a cell's point.
std::array<std::uint32_t, 3> offsets_of(const Input& in) {
    const std::uint64_t key =
        octave_key(in.noise_seed, in.channel_seed, Purpose::cells, {1 << 20, 1 << 20, 1 << 20});
    const CellPoint point = cell_point(row_key(key, in.y, in.z), in.x);
    const auto bits = [](float f) { return static_cast<std::uint32_t>(f * 0x1p24f); };
    return {bits(point.x), bits(point.y), bits(point.z)};
}

// The largest deviation from one half, over all pairs of an input bit and an output bit, of how
// often flipping the one flips the other; inputs are small numbers, as lattices have them.
template <class Outputs>
double avalanche(int input_bits, void (*flip)(Input&, int), const Outputs& outputs,
                 int output_bits) {
    constexpr int kSamples = 4096;
    double worst = 0;
    for (int bit = 0; bit < input_bits; ++bit) {
        std::vector<int> flips(outputs(Input{}).size() * 32, 0);
        for (std::uint32_t i = 0; i < kSamples; ++i) {
            Input in{7, i % 3, i % 64, i / 64 % 8, i / 512};
            const auto before = outputs(in);
            flip(in, bit);
            const auto after = outputs(in);
            for (std::size_t k = 0; k < before.size(); ++k) {
                for (std::uint32_t changed = before[k] ^ after[k]; changed != 0;
                     changed &= changed - 1) {
                    ++flips[k * 32 + static_cast<std::size_t>(std::countr_zero(changed))];
                }
            }
        }
        for (std::size_t k = 0; k < flips.size(); ++k) {
            if (static_cast<int>(k % 32) >= output_bits) continue;
            worst =
                std::max(worst, std::fabs(flips[k] - kSamples / 2.0) / std::sqrt(kSamples / 4.0));
        }
    }
    return worst;
}

template <class Outputs>
void hold_avalanche(const char* of, const Outputs& outputs, int output_bits) {
    using Flip = void (*)(Input&, int);
    const auto row = [&](const char* input, int bits, Flip flip) {
        hold(fmt::format("{} avalanche of {}", of, input),
             fmt::format("flips with p = 1/2, {} x {} pairs, sigma", bits, output_bits),
             avalanche(bits, flip, outputs, output_bits), kLargestOfThousands);
    };
    row("x", 32, [](Input& in, int bit) { in.x ^= 1u << bit; });
    row("y", 32, [](Input& in, int bit) { in.y ^= 1u << bit; });
    row("z", 32, [](Input& in, int bit) { in.z ^= 1u << bit; });
    row("the seed", 64, [](Input& in, int bit) { in.noise_seed ^= std::uint64_t{1} << bit; });
    row("the channel's seed", 64,
        [](Input& in, int bit) { in.channel_seed ^= std::uint64_t{1} << bit; });
}

TEST(NoiseHardCase, HashAvalanche) {
    const auto hash = [](const Input& in) {
        const std::uint64_t key = octave_key(in.noise_seed, in.channel_seed, Purpose::gradient,
                                             {1 << 20, 1 << 20, 1 << 20});
        return std::array{lattice_hash(row_key(key, in.y, in.z), in.x)};
    };
    hold_avalanche("hash", hash, 32);
    hold_avalanche("cell point", offsets_of, 24);
}

// --- Chi-square ---------------------------------------------------------------------------------

// How far counts are from equal shares: chi-square in its standard deviations.
double chi_square(const std::vector<std::int64_t>& counts) {
    std::int64_t total = 0;
    for (const std::int64_t count : counts) total += count;
    const double share = static_cast<double>(total) / static_cast<double>(counts.size());
    double sum = 0;
    for (const std::int64_t count : counts) {
        const double apart = static_cast<double>(count) - share;
        sum += apart * apart / share;
    }
    const auto freedom = static_cast<double>(counts.size() - 1);
    return (sum - freedom) / std::sqrt(2 * freedom);
}

constexpr int kSide = 64;

// Calls visit(x, y, z) for all points of a lattice.
template <class Visit>
void for_each_point(const Visit& visit) {
    testing::for_each_voxel({kSide, kSide, kSide}, visit);
}

std::uint64_t key_of(Purpose purpose) { return octave_key(7, 0, purpose, {kSide, kSide, kSide}); }

// The points themselves, and each with its neighbour along an axis.
constexpr std::array<std::array<std::uint32_t, 3>, 4> kSteps = {
    {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
constexpr std::array<const char*, 4> kStepNames = {"alone", "with x + 1", "with y + 1",
                                                   "with z + 1"};

TEST(NoiseHardCase, HashBits) {
    const std::uint64_t key = key_of(Purpose::gradient);
    for (std::size_t step = 0; step < 4; ++step) {
        // Counts the four combinations of each pair of bits of a point and of its neighbour.
        std::vector<std::vector<std::int64_t>> counts(32 * 32, std::vector<std::int64_t>(4, 0));
        for_each_point([&](std::uint32_t x, std::uint32_t y, std::uint32_t z) {
            const auto& [dx, dy, dz] = kSteps[step];
            const std::uint32_t here = lattice_hash(row_key(key, y, z), x);
            const std::uint32_t there = lattice_hash(row_key(key, y + dy, z + dz), x + dx);
            for (std::size_t i = 0; i < 32; ++i) {
                for (std::size_t j = 0; j < 32; ++j) {
                    ++counts[i * 32 + j][((here >> i) & 1u) * 2 + ((there >> j) & 1u)];
                }
            }
        });
        double worst = 0;
        for (std::size_t i = 0; i < 32 * 32; ++i) {
            if (step == 0 && i % 33 == 0) continue;  // a bit with itself
            worst = std::max(worst, chi_square(counts[i]));
        }
        // Chi-square of 3 degrees of freedom has a longer tail than the normal distribution: the
        // largest of a thousand is about 5, beyond 11 is one in 10^5 such sets.
        hold(fmt::format("hash bits {}, {} pairs", kStepNames[step], 32 * 32),
             "equal shares, chi-square in sigma", worst, 11);
    }
}

TEST(NoiseHardCase, HashGradientDirections) {
    const std::uint64_t key = key_of(Purpose::gradient);
    const auto direction = [&](std::uint32_t x, std::uint32_t y, std::uint32_t z) {
        const Gradient g = lattice_gradient(row_key(key, y, z), x);
        const std::size_t axis = g.x == 0 ? 0 : g.y == 0 ? 1 : 2;
        const float first = axis == 0 ? g.y : g.x;
        const float second = axis == 2 ? g.y : g.z;
        EXPECT_EQ(std::fabs(g.x) + std::fabs(g.y) + std::fabs(g.z), 2);
        return axis * 4 + (first < 0 ? 2u : 0u) + (second < 0 ? 1u : 0u);
    };
    std::vector<std::size_t> directions;
    for_each_point([&](std::uint32_t x, std::uint32_t y, std::uint32_t z) {
        directions.push_back(direction(x, y, z));
    });
    std::vector<std::int64_t> bins(12, 0);
    for (const std::size_t d : directions) ++bins[d];
    hold("gradients, 12 directions", "equal shares, chi-square in sigma", chi_square(bins),
         kLargestOfAFew);
    for (std::size_t step = 1; step < 4; ++step) {
        std::vector<std::int64_t> pairs(144, 0);
        for_each_point([&](std::uint32_t x, std::uint32_t y, std::uint32_t z) {
            const auto& [dx, dy, dz] = kSteps[step];
            const auto at = [&](std::uint32_t i, std::uint32_t j, std::uint32_t k) {
                return directions[((k % kSide) * kSide + j % kSide) * kSide + i % kSide];
            };
            ++pairs[at(x, y, z) * 12 + at(x + dx, y + dy, z + dz)];
        });
        hold(fmt::format("gradients {}, 144 pairs", kStepNames[step]),
             "equal shares, chi-square in sigma", chi_square(pairs), kLargestOfAFew);
    }
}

TEST(NoiseHardCase, HashCellPoints) {
    const std::uint64_t key = key_of(Purpose::cells);
    constexpr std::size_t kBins = 32;
    const auto point = [&](std::uint32_t x, std::uint32_t y, std::uint32_t z) {
        const CellPoint p = cell_point(row_key(key, y, z), x);
        return std::array<float, 3>{p.x, p.y, p.z};
    };
    for (std::size_t step = 0; step < 4; ++step) {
        double worst = 0;
        std::array<std::array<std::vector<std::int64_t>, 3>, 3> bins;
        for (auto& row : bins) row.fill(std::vector<std::int64_t>(kBins * kBins, 0));
        for_each_point([&](std::uint32_t x, std::uint32_t y, std::uint32_t z) {
            const auto& [dx, dy, dz] = kSteps[step];
            const auto here = point(x, y, z);
            const auto there = point(x + dx, y + dy, z + dz);
            for (std::size_t i = 0; i < 3; ++i) {
                for (std::size_t j = 0; j < 3; ++j) {
                    EXPECT_TRUE(here[i] >= 0 && here[i] < 1);
                    ++bins[i][j][static_cast<std::size_t>(here[i] * kBins) * kBins +
                                 static_cast<std::size_t>(there[j] * kBins)];
                }
            }
        });
        for (std::size_t i = 0; i < 3; ++i) {
            for (std::size_t j = 0; j < 3; ++j) {
                if (step > 0 || i != j) worst = std::max(worst, chi_square(bins[i][j]));
            }
        }
        hold(fmt::format("cell points {}, 32 x 32 bins", kStepNames[step]),
             "equal shares, chi-square in sigma", worst, kLargestOfAFew);
    }
}

// --- Seeds --------------------------------------------------------------------------------------

constexpr std::array<std::uint64_t, 8> kSeeds = {0,
                                                 1,
                                                 2,
                                                 0x7fffffffffffffffu,
                                                 0x8000000000000000u,
                                                 0xfffffffffffffffdu,
                                                 0xfffffffffffffffeu,
                                                 0xffffffffffffffffu};

TEST(NoiseHardCase, SeedsAndPurposesHaveKeysOfTheirOwn) {
    std::set<std::uint64_t> keys;
    int count = 0;
    for (const std::uint64_t noise_seed : kSeeds) {
        for (const std::uint64_t channel_seed : kSeeds) {
            for (const Purpose purpose : {Purpose::gradient, Purpose::cells, Purpose::potential_x,
                                          Purpose::potential_y, Purpose::potential_z}) {
                for (const test::Frequency& f : {test::Frequency{1, 1, 1},
                                                 {1, 1, 2},
                                                 {1, 2, 1},
                                                 {2, 1, 1},
                                                 {256, 256, 256},
                                                 {1 << 20, 1, 1}}) {
                    keys.insert(octave_key(noise_seed, channel_seed, purpose, f));
                    ++count;
                }
            }
        }
    }
    hold(fmt::format("keys of {} seeds, purposes, frequencies", count), "all different: repeated",
         count - static_cast<double>(keys.size()), 0);
}

// Correlation of an octave of 4096 cells under two seeds: like that of independent ones.
TEST(NoiseHardCase, SeedsGiveUnrelatedFields) {
    constexpr int kSize = 32;
    const auto field = [](std::uint64_t noise_seed, std::uint64_t channel_seed) {
        config::NoiseChannel channel = test::perlin({{16, 16, 16}});
        channel.seed = channel_seed;
        return test::whole(test::noise_of({channel}, noise_seed), {kSize, kSize, kSize})[0];
    };
    std::vector<std::vector<float>> fields;
    for (const std::uint64_t seed : kSeeds) {
        fields.push_back(field(seed, 0));
        if (seed != 0) fields.push_back(field(0, seed));
    }
    double worst = 0;
    int pairs = 0;
    for (std::size_t a = 0; a < fields.size(); ++a) {
        for (std::size_t b = 0; b < a; ++b, ++pairs) {
            double product = 0;
            double squares_a = 0;
            double squares_b = 0;
            for (std::size_t i = 0; i < fields[a].size(); ++i) {
                const double u = fields[a][i] - 0.5;
                const double v = fields[b][i] - 0.5;
                product += u * v;
                squares_a += u * u;
                squares_b += v * v;
            }
            worst = std::max(worst, std::fabs(product) / std::sqrt(squares_a * squares_b));
        }
    }
    hold(fmt::format("seeds 0 ... 2^64-1, {} pairs of fields", pairs),
         "uncorrelated, 4096 cells: correlation", worst, 5 / std::sqrt(4096.0));
}

TEST(NoiseHardCase, EqualOctavesAreTheSameField) {
    const auto plane = [](const config::Noise& noise, std::size_t channel) {
        return test::whole(noise, {24, 24, 24})[channel];
    };
    config::NoiseChannel other = test::worley({{6, 6, 6}});
    other.seed = 1;
    // A channel of octave 6 alone, and what is left of a channel of 3 and 6 without its 3.
    config::NoiseChannel both = test::worley({{3, 3, 3}, {6, 6, 6}});
    both.octaves.gains = {0, 1};
    const config::Noise noise =
        test::noise_of({test::worley({{6, 6, 6}}), both, other, test::worley({{6, 6, 7}})});
    EXPECT_EQ(plane(noise, 0), plane(noise, 1));
    EXPECT_NE(plane(noise, 0), plane(noise, 2));
    EXPECT_NE(plane(noise, 0), plane(noise, 3));
    const config::Noise gradients = test::noise_of(
        {test::perlin({{6, 6, 6}}), test::perlin({{6, 6, 6}}), test::perlin({{6, 6, 7}})});
    EXPECT_EQ(plane(gradients, 0), plane(gradients, 1));
    EXPECT_NE(plane(gradients, 0), plane(gradients, 2));
    // The same channel elsewhere: what stands beside it changes nothing.
    EXPECT_EQ(plane(test::noise_of({both}), 0), plane(noise, 1));
}

}  // namespace
}  // namespace skybake::noise
