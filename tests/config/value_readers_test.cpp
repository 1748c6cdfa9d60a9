#include "config/fields/kinds.h"

#include <gtest/gtest.h>

#include "tests/config/noises.h"

namespace skybake::config {
namespace {

using testing::channel_of;
using testing::channel_recipe;
using testing::valid;

std::uint64_t seed_of(const std::string& text) {
    return channel_of("type = 'perlin'\nseed = " + text).seed;
}

TEST(ValueReaders, SeedsAreIntegersOrText) {
    EXPECT_EQ(seed_of("0"), 0u);
    EXPECT_EQ(seed_of("9223372036854775807"), 9223372036854775807u);
    EXPECT_EQ(seed_of("'9223372036854775808'"), 9223372036854775808u);
    EXPECT_EQ(seed_of("'18446744073709551615'"), 18446744073709551615u);
    EXPECT_EQ(seed_of("'0xffffffffffffffff'"), 18446744073709551615u);
    EXPECT_EQ(seed_of("'0X1f'"), 31u);
    EXPECT_EQ(seed_of("'010'"), 10u);
}

// On the command line quotes are a nuisance, and not needed.
TEST(ValueReaders, ASettingMayBeAnySeed) {
    const Recipe recipe =
        valid(channel_recipe("type = 'perlin'"), {"noise.n.seed=18446744073709551615"});
    EXPECT_EQ(recipe.parameters.noises.at(0).seed, 18446744073709551615u);
}

TEST(ValueReaders, FrequenciesAreOneNumberOrOnePerAxis) {
    using Frequencies = std::vector<std::array<int, 3>>;
    EXPECT_EQ(channel_of("type = 'perlin'\nfrequency = 7").octaves.frequencies,
              (Frequencies{{7, 7, 7}}));
    EXPECT_EQ(channel_of("type = 'perlin'\nfrequency = [1, 2, 1048576]").octaves.frequencies,
              (Frequencies{{1, 2, 1048576}}));
    EXPECT_EQ(channel_of("type = 'worley'\nfrequencies = [8, [1, 2, 3]]").octaves.frequencies,
              (Frequencies{{8, 8, 8}, {1, 2, 3}}));
}

TEST(ValueReaders, RemapsMayFall) {
    EXPECT_EQ(channel_of("type = 'perlin'\nremap = [1, 0.25, -3, 2]").remap,
              (std::array<double, 4>{1, 0.25, -3, 2}));
}

}  // namespace
}  // namespace skybake::config
