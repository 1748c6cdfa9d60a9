#include "config/text/text.h"

#include <gtest/gtest.h>

namespace skybake::config {
namespace {

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

}  // namespace
}  // namespace skybake::config
