#include "config/diagnostics/diagnostic.h"

#include <gtest/gtest.h>

namespace skybake::config {
namespace {

TEST(DiagnosticList, SortsByPlace) {
    const Source first{Source::Kind::file, 0, "base.toml", "one\ntwo\n"};
    const Source second{Source::Kind::file, 1, "top.toml", "one\ntwo\n"};
    DiagnosticList list;
    list.error("E3", {&second, 1, 1, 1}, "");
    list.error("E2", {&first, 2, 1, 1}, "");
    list.warning("W1", {&first, 1, 2, 1}, "");
    EXPECT_TRUE(list.has_errors());
    const auto diagnostics = list.take();
    ASSERT_EQ(diagnostics.size(), 3u);
    EXPECT_EQ(diagnostics[0].code, "W1");
    EXPECT_EQ(diagnostics[0].severity, Severity::warning);
    EXPECT_EQ(diagnostics[1].code, "E2");
    EXPECT_EQ(diagnostics[2].code, "E3");
}

// Errors, which a person has to mend, are the last on the screen, however many warnings there are.
TEST(DiagnosticList, ErrorsComeLast) {
    const Source source{Source::Kind::file, 0, "a.toml", "one\ntwo\nthree\n"};
    DiagnosticList list;
    list.error("E1", {&source, 1, 1, 1}, "");
    list.warning("W3", {&source, 3, 1, 1}, "");
    list.error("E2", {&source, 2, 1, 1}, "");
    list.warning("W2", {&source, 2, 1, 1}, "");
    std::string codes;
    for (const Diagnostic& diagnostic : list.take()) codes += diagnostic.code;
    EXPECT_EQ(codes, "W2W3E1E2");
}

TEST(DiagnosticList, AWarningIsNoError) {
    DiagnosticList list;
    list.warning("W0202", {}, "");
    EXPECT_FALSE(list.has_errors());
}

TEST(DiagnosticList, ShowsTheLine) {
    const Source source{Source::Kind::file, 0, "a.toml", "first\r\nsecond \u00b5\r\nlast"};
    EXPECT_EQ(source_range({&source, 1, 1, 1}).line_text, "first");
    EXPECT_EQ(source_range({&source, 2, 1, 1}).line_text, "second \u00b5");
    EXPECT_EQ(source_range({&source, 3, 1, 1}).line_text, "last");
    EXPECT_EQ(source_range({&source, 9, 1, 1}).line_text, "");
}

TEST(DiagnosticList, EscapesWhatATerminalCannotShow) {
    const Source source{Source::Kind::file, 0, "a.toml",
                        std::string(5000, 'x') + "\n\x1b[31m\n\xff\n\tfine"};
    EXPECT_EQ(source_range({&source, 1, 1, 1}).line_text, "");
    EXPECT_EQ(source_range({&source, 2, 1, 1}).line_text, "\\u001b[31m");
    EXPECT_EQ(source_range({&source, 3, 1, 1}).line_text, "\\xff");
    EXPECT_EQ(source_range({&source, 4, 1, 1}).line_text, "\tfine");
}

TEST(DiagnosticList, SettingsHaveNoLines) {
    const Source source{Source::Kind::setting, 0, "--set `a=1`", ""};
    const SourceRange range = source_range({&source, 1, 1, 1});
    EXPECT_EQ(range.source, "--set `a=1`");
    EXPECT_EQ(range.line, 0);
}

TEST(DiagnosticList, StopsAtAThousand) {
    DiagnosticList list;
    for (int i = 0; i < 1500; ++i) list.error("E0102", {}, "");
    const auto diagnostics = list.take();
    ASSERT_EQ(diagnostics.size(), 1001u);
    EXPECT_EQ(diagnostics.back().code, "E0123");
    EXPECT_EQ(diagnostics.back().message, "too many errors: 500 more not shown");
}

}  // namespace
}  // namespace skybake::config
