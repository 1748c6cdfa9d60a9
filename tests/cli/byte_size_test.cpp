#include "cli/options.h"

#include <gtest/gtest.h>

#include "bakers/io/files/to_string.h"

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
    EXPECT_EQ(parse_byte_size("2G"), 2147483648U);
    EXPECT_EQ(parse_byte_size("0.5 K"), 512U);
    EXPECT_EQ(parse_byte_size("3M"), 3145728U);
    EXPECT_EQ(parse_byte_size("1T"), 1099511627776U);
}

TEST(ByteSize, IsToldInFittingUnits) {
    EXPECT_EQ(byte_size_text(2), "2 B");
    EXPECT_EQ(byte_size_text(1023), "1023 B");
    EXPECT_EQ(byte_size_text(1024), "1 KiB");
    EXPECT_EQ(byte_size_text(1.5 * 1024 * 1024), "1.5 MiB");
    EXPECT_EQ(byte_size_text(2147483648.0), "2.0 GiB");
}

TEST(ByteSize, RefusesEverythingElse) {
    for (const char* text : {"", "GiB", "-1", "1e3", "nan", "inf", "1 GiB ", "1  GiB", "1gib",
                             "0x10", "1g", "9999999TiB", "1,5GiB", "+1"}) {
        EXPECT_EQ(parse_byte_size(text), std::nullopt) << text;
    }
}

}  // namespace
}  // namespace skybake::cli
