#include "config/text/text.h"

#include <gtest/gtest.h>

#include "tests/config/recipes.h"

namespace skybake::config {
namespace {

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

}  // namespace
}  // namespace skybake::config
