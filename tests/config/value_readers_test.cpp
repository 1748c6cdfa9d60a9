#include "config/fields/kinds.h"

#include <gtest/gtest.h>

#include "tests/config/noises.h"

namespace skybake::config {
namespace {

using testing::channel_of;
using testing::channel_recipe;
using testing::only_diagnostic;
using testing::parse;
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

TEST(ValueReaders, OtherSeedsAreRefused) {
    const auto code = [](const std::string& text) {
        return only_diagnostic(channel_recipe("type = 'perlin'\nseed = " + text)).code;
    };
    EXPECT_EQ(code("-1"), "E0110");
    EXPECT_EQ(code("'18446744073709551616'"), "E0110");
    EXPECT_EQ(code("'0x10000000000000000'"), "E0110");
    for (const char* text : {"1.0", "nan", "true", "''", "'0x'", "'-1'", "'+1'", "' 1'", "'1 '",
                             "'1e3'", "'0xg'", "'seven'", "[1]"}) {
        EXPECT_EQ(code(text), "E0103") << text;
    }
}

// On the command line quotes are a nuisance, and not needed.
TEST(ValueReaders, ASettingMayBeAnySeed) {
    const Recipe recipe =
        valid(channel_recipe("type = 'perlin'"), {"noise.n.seed=18446744073709551615"});
    EXPECT_EQ(recipe.parameters.noises.at(0).seed, 18446744073709551615u);
}

TEST(ValueReaders, AHugeSeedInAFileIsAdvised) {
    const Diagnostic diagnostic = only_diagnostic("[noise.n]\nseed = 18446744073709551615\n");
    EXPECT_EQ(diagnostic.code, "E0101");
    EXPECT_EQ(diagnostic.label, "write a number above 2^63 - 1 in quotes");
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

struct Refused {
    std::string keys;
    std::string code;
};

TEST(ValueReaders, RefusesWhatIsNone) {
    const std::vector<Refused> all = {
        {"frequency = 0", "E0110"},
        {"frequency = -4", "E0110"},
        {"frequency = 1048577", "E0110"},
        {"frequency = 9223372036854775807", "E0110"},
        {"frequency = 4.0", "E0103"},
        {"frequency = '4'", "E0103"},
        {"frequency = [4, 4]", "E0108"},
        {"frequency = [4, 4, 0]", "E0110"},
        {"frequencies = []", "E0108"},
        {"frequencies = 4", "E0103"},
        {"frequencies = [1,1,1,1,1,1,1,1,1,1,1,1,1,1,1,1,1]", "E0108"},
        {"frequencies = [[4, 4]]", "E0108"},
        {"octaves = 0", "E0110"},
        {"octaves = 17", "E0110"},
        {"octaves = 2.5", "E0103"},
        {"lacunarity = 0", "E0110"},
        {"lacunarity = 17", "E0110"},
        {"gain = nan", "E0110"},
        {"gain = -0.5", "E0110"},
        {"gain = inf", "E0110"},
        {"gain = 4.5", "E0110"},
        {"gains = [nan]", "E0110"},
        {"gains = [-1.0]", "E0110"},
        {"gains = [0, 0.0]", "E0110"},
        {"gains = []", "E0108"},
        {"gains = 0.5", "E0103"},
        {"gains = ['1 %']", "E0107"},
        {"remap = [0, 1, 0]", "E0108"},
        {"remap = 1", "E0103"},
        {"remap = [0.5, 0.5, 0, 1]", "E0110"},
        {"remap = [0, 1e-7, 0, 1]", "E0110"},
        {"remap = [0, 1, 0, inf]", "E0110"},
        {"remap = [0, 1, 0, 1e7]", "E0110"},
        {"bias = 0", "E0110"},
        {"bias = 1", "E0110"},
        {"bias = nan", "E0110"},
        {"invert = 1", "E0103"},
    };
    for (const Refused& refused : all) {
        const Diagnostic diagnostic =
            only_diagnostic(channel_recipe("type = 'perlin'\n" + refused.keys));
        EXPECT_EQ(diagnostic.code, refused.code) << refused.keys;
        EXPECT_EQ(diagnostic.where.line, 3) << refused.keys;
        EXPECT_FALSE(diagnostic.label.empty()) << refused.keys;
    }
}

TEST(ValueReaders, RemapsMayFall) {
    EXPECT_EQ(channel_of("type = 'perlin'\nremap = [1, 0.25, -3, 2]").remap,
              (std::array<double, 4>{1, 0.25, -3, 2}));
}

}  // namespace
}  // namespace skybake::config
