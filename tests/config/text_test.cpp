#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <vector>

#include "config/fields/kinds.h"
#include "config/text/key_path.h"
#include "config/text/text.h"
#include "tests/config/noises.h"
#include "tests/config/recipes.h"

namespace skybake::config {
namespace {

using Names = std::vector<std::string>;
using testing::channel_of;
using testing::channel_recipe;

TEST(KeyPath, QuotesWhatIsNoBareKey) {
    EXPECT_EQ(join_path("atmosphere.layers", "mie"), "atmosphere.layers.mie");
    EXPECT_EQ(join_path("", "bake"), "bake");
    EXPECT_EQ(join_path("a", "sea fog"), "a.\"sea fog\"");
    EXPECT_EQ(join_path("a", "x.y"), "a.\"x.y\"");
    EXPECT_EQ(key_to_string(""), "\"\"");
    EXPECT_EQ(toml_string("a\"b\\c\n\x01"), "\"a\\\"b\\\\c\\n\\u0001\"");
}

TEST(KeyPath, SplitsPaths) {
    EXPECT_EQ(split_path("a.b-1.c_d"), (Names{"a", "b-1", "c_d"}));
    EXPECT_EQ(split_path("a.\"x.y\".*"), (Names{"a", "x.y", "*"}));
    for (const char* bad :
         {"", ".", "a.", ".a", "a..b", "a b", "\"a", "\"a\"b", "\"\\q\"", "\"\\u00"}) {
        EXPECT_EQ(split_path(bad), std::nullopt) << bad;
    }
}

TEST(KeyPath, SplitUndoesJoin) {
    EXPECT_TRUE(rc::check("split(join(names)) == names", [](const Names& names) {
        RC_PRE(!names.empty());
        std::string path;
        for (const std::string& name : names) path = join_path(path, name);
        RC_ASSERT(split_path(path) == names);
    }));
}

TEST(KeyPath, MatchesPatterns) {
    EXPECT_TRUE(path_matches("atmosphere.layers.mie.g", "atmosphere.layers.*.g"));
    EXPECT_TRUE(path_matches("wavelengths", "wavelengths"));
    EXPECT_TRUE(path_matches("a.\"x.y\"", "a.*"));
    EXPECT_FALSE(path_matches("atmosphere.layers.mie.g", "atmosphere.layers.*"));
    EXPECT_FALSE(path_matches("atmosphere.layers", "atmosphere.layers.*"));
    EXPECT_FALSE(path_matches("a.b", "a.c"));
    EXPECT_FALSE(path_matches("a.b.c", "a.b"));
    EXPECT_FALSE(path_matches("a.b", "a.b.c"));
    EXPECT_FALSE(path_matches("a.b.", "a.b"));
    EXPECT_FALSE(path_matches("a.b", ""));
}

TEST(KeyPath, MakesTextPrintable) {
    EXPECT_EQ(printable("caf\u00e9\t\x1b[1m"), "caf\u00e9\\t\\u001b[1m");
    EXPECT_EQ(printable("a\xff\xfe z"), "a\\xff\\xfe z");
    // Characters that would turn the rest of the line around; the dash beside them stays.
    EXPECT_EQ(printable("q\u202eZ\u200f\u2066\u2010"), "q\\u202eZ\\u200f\\u2066\u2010");
    EXPECT_EQ(shorten(std::string(100, 'a')), std::string(60, 'a') + "...");
    EXPECT_EQ(shorten(std::string(59, 'a') + "\u00b5\u00b5"), std::string(59, 'a') + "...");
}

const std::vector<std::string_view> known = {"scale_height", "scattering", "phase", "profile", "g"};

TEST(Suggest, CountsEdits) {
    EXPECT_EQ(edit_distance("", ""), 0);
    EXPECT_EQ(edit_distance("", "abc"), 3);
    EXPECT_EQ(edit_distance("kitten", "sitting"), 3);
    EXPECT_EQ(edit_distance("hieght", "height"), 1);  // a swap
}

TEST(Suggest, FindsTheNearestName) {
    EXPECT_EQ(nearest_name("scale_hieght", known), "scale_height");
    EXPECT_EQ(nearest_name("scatering", known), "scattering");
    EXPECT_EQ(nearest_name("Phase", known), "phase");
    EXPECT_EQ(did_you_mean("profil", known), "did you mean `profile`?");
}

TEST(Suggest, StaysSilentWhereNothingIsNear) {
    EXPECT_EQ(nearest_name("temperature", known), std::nullopt);
    EXPECT_EQ(nearest_name("", known), std::nullopt);
    EXPECT_EQ(nearest_name("x", known), std::nullopt);
    EXPECT_EQ(nearest_name(std::string(1000, 'a'), known), std::nullopt);
    EXPECT_EQ(did_you_mean("temperature", known), "");
}

TEST(Suggest, DistanceIsSymmetricAndZeroForEquals) {
    EXPECT_TRUE(rc::check("a distance", [](const std::string& a, const std::string& b) {
        RC_ASSERT(edit_distance(a, b) == edit_distance(b, a));
        RC_ASSERT((edit_distance(a, b) == 0) == (a == b));
        RC_ASSERT(edit_distance(a, b) <= static_cast<int>(std::max(a.size(), b.size())));
    }));
}

TEST(Utf8, AcceptsAllOfUnicode) {
    EXPECT_FALSE(find_invalid_utf8(""));
    EXPECT_FALSE(find_invalid_utf8("plain"));
    EXPECT_FALSE(find_invalid_utf8("\u00b5 \u20ac \U0001f30d \xf4\x8f\xbf\xbf \xed\x9f\xbf"));
}

TEST(Utf8, FindsWhatIsNot) {
    using namespace std::string_view_literals;
    EXPECT_EQ(find_invalid_utf8("ab\xff"), 2u);
    EXPECT_EQ(find_invalid_utf8("a\0b"sv), 1u);            // NUL
    EXPECT_EQ(find_invalid_utf8("\xc3"), 0u);              // cut off
    EXPECT_EQ(find_invalid_utf8("\xc0\x80"), 0u);          // overlong
    EXPECT_EQ(find_invalid_utf8("\xe0\x80\x80"), 0u);      // overlong
    EXPECT_EQ(find_invalid_utf8("\xed\xa0\x80"), 0u);      // surrogate
    EXPECT_EQ(find_invalid_utf8("\xf4\x90\x80\x80"), 0u);  // above U+10FFFF
    EXPECT_EQ(find_invalid_utf8("x\xe2\x82z"), 1u);
}

TEST(TextFile, ReadsUpToTheBound) {
    const testing::TemporaryFolder folder;
    const auto text = read_text_file(folder.write("a", std::string(100, 'x')), 100);
    ASSERT_TRUE(std::holds_alternative<std::string>(text));
    EXPECT_EQ(std::get<std::string>(text), std::string(100, 'x'));
}

TEST(TextFile, RefusesMore) {
    const testing::TemporaryFolder folder;
    const auto text = read_text_file(folder.write("a", std::string(101, 'x')), 100);
    ASSERT_TRUE(std::holds_alternative<FileError>(text));
    EXPECT_TRUE(std::get<FileError>(text).too_large);
}

TEST(TextFile, RefusesADeviceWithoutEnd) {
    const auto text = read_text_file("/dev/zero", 1000);
    ASSERT_TRUE(std::holds_alternative<FileError>(text));
    EXPECT_TRUE(std::get<FileError>(text).too_large);
}

TEST(TextFile, SaysWhyItCannotRead) {
    const testing::TemporaryFolder folder;
    const auto missing = read_text_file(folder.path() / "none", 100);
    ASSERT_TRUE(std::holds_alternative<FileError>(missing));
    EXPECT_EQ(std::get<FileError>(missing).reason, "No such file or directory");
    const auto directory = read_text_file(folder.path(), 100);
    ASSERT_TRUE(std::holds_alternative<FileError>(directory));
    EXPECT_EQ(std::get<FileError>(directory).reason, "Is a directory");
}

TEST(TextFile, DropsAByteOrderMark) {
    EXPECT_EQ(without_byte_order_mark("\xef\xbb\xbfx"), "x");
    EXPECT_EQ(without_byte_order_mark("x"), "x");
}

TEST(TextLayout, BreaksAtBlanks) {
    EXPECT_EQ(wrap("one two three", "# ", 10), "# one two\n# three\n");
    EXPECT_EQ(wrap("", "# ", 10), "# \n");
    EXPECT_EQ(wrap("unbreakable", "", 4), "unbreakable\n");
    EXPECT_EQ(wrap("a\nb", "- ", 80), "- a\n- b\n");
}

TEST(TextLayout, CountsCharacters) {
    EXPECT_EQ(wrap("\u00b5\u00b5 \u00b5\u00b5", "", 5), "\u00b5\u00b5 \u00b5\u00b5\n");
}

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
