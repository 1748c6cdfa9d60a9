#include "config/text/text.h"

#include <gtest/gtest.h>

#include <string>

namespace skybake::config {
namespace {

std::string dotted(int names) {
    std::string key = "a";
    for (int i = 1; i < names; ++i) key += ".a";
    return key;
}

TEST(Nesting, FindsLongKeysAndDeepBrackets) {
    EXPECT_FALSE(find_deep_nesting(dotted(8) + " = 1", 8));
    EXPECT_TRUE(find_deep_nesting(dotted(9) + " = 1", 8));
    EXPECT_TRUE(find_deep_nesting("[" + dotted(9) + "]", 8));
    EXPECT_TRUE(find_deep_nesting("x = {" + dotted(9) + " = 1}", 8));
    EXPECT_TRUE(find_deep_nesting("x = " + std::string(9, '['), 8));
    EXPECT_FALSE(find_deep_nesting("x = " + std::string(8, '[') + std::string(8, ']'), 8));
    EXPECT_TRUE(find_deep_nesting("\"a\".\"b\".'c'.d", 3));
}

TEST(Nesting, SkipsStringsAndComments) {
    EXPECT_FALSE(find_deep_nesting("# " + dotted(9) + "\nx = \"" + dotted(9) + "\"", 8));
    EXPECT_FALSE(find_deep_nesting("x = '" + dotted(9) + "'", 8));
    EXPECT_FALSE(find_deep_nesting("x = \"\"\"\n" + dotted(9) + "\n\"\"\"", 8));
    EXPECT_FALSE(find_deep_nesting("x = \"\\\"" + dotted(9) + "\"", 8));
    EXPECT_FALSE(find_deep_nesting("x = \"unterminated " + dotted(9), 8));
}

TEST(Nesting, SaysWhere) {
    const auto found = find_deep_nesting("x = 1\n\u00b5 = [[[", 2);
    ASSERT_TRUE(found);
    EXPECT_EQ(found->line, 2);
    EXPECT_EQ(found->column, 7);
}

TEST(Nesting, CountsLinesAndCodePoints) {
    const TextPosition position = text_position("a\n\u00b5\u00b5b", 6);
    EXPECT_EQ(position.line, 2);
    EXPECT_EQ(position.column, 3);
}

}  // namespace
}  // namespace skybake::config
