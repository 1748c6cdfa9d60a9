#include "config/text/key_path.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>

namespace skybake::config {
namespace {

using Names = std::vector<std::string>;

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

}  // namespace
}  // namespace skybake::config
