#include "cli/table_printer.h"

#include <gtest/gtest.h>

#include <array>
#include <sstream>
#include <utility>

namespace skybake::cli {
namespace {

TEST(TablePrinter, AlignsColumns) {
    TextTable table({Align::left, Align::right});
    table.add_row({"asset", "bytes", "error"});
    table.add_row({"transmittance", "12", ""});
    table.add_row({"µ", "1234567"});
    EXPECT_EQ(table.text(),
              "  asset            bytes  error\n"
              "  transmittance       12\n"
              "  µ              1234567\n");
}

TEST(TimeText, HasNoPowersOfTen) {
    const std::pair<double, const char*> times[] = {
        {0.0023, "2.3 ms"}, {0.0478, "48 ms"}, {1.249, "1.25 s"}, {99.96, "100 s"},
        {250.3, "250 s"},   {999.7, "1000 s"}, {86400, "86400 s"}};
    for (const auto& [seconds, text] : times) EXPECT_EQ(time_text(seconds), text);
}

TEST(TablePrinter, FitsTheTerminal) {
    TextTable table({Align::left, Align::right, Align::left, Align::right});
    table.add_row({"asset", "size", "file", "write"});
    table.add_row({"µ_transmittance", "256x64", "transmittance_of_air.exr", "12 ms"});
    constexpr std::array<std::size_t, 1> expendable = {3};
    constexpr std::array<std::size_t, 2> shrinkable = {0, 2};
    const std::string whole = table.text();
    EXPECT_EQ(table.text_within(0, expendable, shrinkable), whole);
    EXPECT_EQ(table.text_within(58, expendable, shrinkable), whole);
    EXPECT_EQ(table.text_within(57, expendable, shrinkable),
              "  asset              size  file\n"
              "  µ_transmittance  256x64  transmittance_of_air.exr\n");
    for (const int columns : {50, 45, 40, 35, 30}) {
        std::istringstream lines(table.text_within(columns, expendable, shrinkable));
        for (std::string line; std::getline(lines, line);) {
            EXPECT_LE(text_width(line), columns) << line;
        }
    }
    EXPECT_EQ(table.text_within(36, expendable, shrinkable),
              "  asset              size  file\n"
              "  µ_transmittance  256x64  transmit…\n");
}

// A column that is dropped moves those behind it; figures stay whole even where they do not fit.
TEST(TablePrinter, OnlyNamesAreShortened) {
    TextTable table({Align::left, Align::right, Align::left, Align::left});
    table.add_row({"abcdefghijkl", "1234567890123", "pqrstuvwxyzpqr", "0.25 / 0.125 / 0.0625"});
    constexpr std::array<std::size_t, 1> expendable = {1};
    constexpr std::array<std::size_t, 2> shrinkable = {0, 2};
    EXPECT_EQ(table.text_within(10, expendable, shrinkable),
              "  abcdefg…  pqrstuv…  0.25 / 0.125 / 0.0625\n");
}

// A column that says nothing but its heading goes; one with a single cell stays.
TEST(TablePrinter, EmptyColumnsAreDropped) {
    TextTable table({Align::left, Align::right, Align::right});
    table.add_row({"asset", "sky", "lookup"});
    table.add_row({"clouds", "", "0.5"});
    TextTable with_sky = table;
    with_sky.add_row({"sky", "0.1", "0.25"});
    table.drop_if_empty(1);
    EXPECT_EQ(table.text(), "  asset   lookup\n  clouds     0.5\n");
    with_sky.drop_if_empty(1);
    EXPECT_EQ(with_sky.text(),
              "  asset   sky  lookup\n  clouds          0.5\n  sky     0.1    0.25\n");
}

TEST(TablePrinter, AnEmptyTableIsNoText) { EXPECT_EQ(TextTable().text(), ""); }

TEST(TextWidth, CountsColumnsNotBytes) {
    EXPECT_EQ(text_width("abc"), 3);
    EXPECT_EQ(text_width("µ²−"), 3);
    EXPECT_EQ(text_width("霧"), 2);
    EXPECT_EQ(text_width("e\u0301"), 1);
    EXPECT_EQ(text_width("\xff\xc3"), 2);
}

TEST(TextWidth, ReadsCodePoints) {
    const std::string text = "a\u00b5\u96e7\U0001F600\xff";
    std::size_t position = 0;
    for (const std::uint32_t wanted : {0x61u, 0xB5u, 0x96E7u, 0x1F600u, 0xFFFDu}) {
        EXPECT_EQ(next_code_point(text, position), wanted);
    }
    EXPECT_EQ(position, text.size());
}

}  // namespace
}  // namespace skybake::cli
