#include "config/text/text.h"

#include <gtest/gtest.h>

namespace skybake::config {
namespace {

TEST(TextLayout, BreaksAtBlanks) {
    EXPECT_EQ(wrap("one two three", "# ", 10), "# one two\n# three\n");
    EXPECT_EQ(wrap("", "# ", 10), "# \n");
    EXPECT_EQ(wrap("unbreakable", "", 4), "unbreakable\n");
    EXPECT_EQ(wrap("a\nb", "- ", 80), "- a\n- b\n");
}

TEST(TextLayout, CountsCharacters) {
    EXPECT_EQ(wrap("\u00b5\u00b5 \u00b5\u00b5", "", 5), "\u00b5\u00b5 \u00b5\u00b5\n");
}

}  // namespace
}  // namespace skybake::config
