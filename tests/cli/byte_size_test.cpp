#include "cli/byte_size.h"

#include <gtest/gtest.h>

namespace skybake::cli {
namespace {

TEST(ByteSize, ReadsUnitsOf1024And1000) {
    EXPECT_EQ(parse_byte_size("0"), 0U);
    EXPECT_EQ(parse_byte_size("4096"), 4096U);
    EXPECT_EQ(parse_byte_size("16 B"), 16U);
    EXPECT_EQ(parse_byte_size("1.5KiB"), 1536U);
    EXPECT_EQ(parse_byte_size("512MiB"), 536870912U);
    EXPECT_EQ(parse_byte_size("2 GiB"), 2147483648U);
    EXPECT_EQ(parse_byte_size("2GB"), 2000000000U);
}

TEST(ByteSize, RefusesEverythingElse) {
    for (const char* text : {"", "GiB", "-1", "1e3", "nan", "inf", "1 GiB ", "1  GiB", "1gib",
                             "0x10", "9999999TiB", "1,5GiB", "+1"}) {
        EXPECT_EQ(parse_byte_size(text), std::nullopt) << text;
    }
}

}  // namespace
}  // namespace skybake::cli
