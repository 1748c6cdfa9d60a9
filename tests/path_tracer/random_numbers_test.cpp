#include "bakers/light/path_tracer/phase_sampling.h"

#include <gtest/gtest.h>

namespace skybake {
namespace {

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

}  // namespace
}  // namespace skybake
