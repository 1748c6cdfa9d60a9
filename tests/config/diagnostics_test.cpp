#include <gtest/gtest.h>

#include <map>
#include <set>
#include <string>
#include <vector>

#include "config/diagnostics/diagnostic.h"
#include "config/diagnostics/diagnostic_codes.h"
#include "config/text/text.h"

namespace skybake::config {
namespace {

Diagnostic diagnostic(const std::string& code) {
    const Severity severity = code[0] == 'E' ? Severity::error : Severity::warning;
    return {severity, code, "", {}, ""};
}

TEST(DiagnosticCodes, AreUniqueAndWellFormed) {
    std::set<std::string_view> seen;
    for (const DiagnosticCode& code : diagnostic_codes()) {
        EXPECT_TRUE(seen.insert(code.code).second) << code.code;
        ASSERT_EQ(code.code.size(), 5u) << code.code;
        EXPECT_TRUE(code.code[0] == 'E' || code.code[0] == 'W') << code.code;
        EXPECT_EQ(code.code[0] == 'W', code.exit_code == 0) << code.code;
        EXPECT_FALSE(code.title.empty()) << code.code;
        EXPECT_FALSE(code.explanation.empty()) << code.code;
        EXPECT_EQ(code.wrong.empty(), code.right.empty()) << code.code;
    }
}

TEST(DiagnosticCodes, RangesSayTheExitCode) {
    const std::map<std::string_view, int> exit_codes = {
        {"E00", 2}, {"E01", 2}, {"E03", 3}, {"E04", 4}, {"E05", 5}, {"W02", 0}, {"W03", 0}};
    for (const DiagnosticCode& code : diagnostic_codes()) {
        const auto range = exit_codes.find(code.code.substr(0, 3));
        ASSERT_NE(range, exit_codes.end()) << code.code;
        EXPECT_EQ(code.exit_code, range->second) << code.code;
    }
}

TEST(DiagnosticCodes, TheGravestErrorDecides) {
    const std::vector<Diagnostic> none;
    const std::vector<Diagnostic> warning = {diagnostic("W0202")};
    const std::vector<Diagnostic> usage = {diagnostic("E0102"), diagnostic("W0202")};
    const std::vector<Diagnostic> both = {diagnostic("E0300"), diagnostic("E0102")};
    const std::vector<Diagnostic> unknown = {diagnostic("E9999")};
    EXPECT_EQ(exit_code(none), 0);
    EXPECT_EQ(exit_code(warning), 0);
    EXPECT_EQ(exit_code(usage), 2);
    EXPECT_EQ(exit_code(both), 3);
    EXPECT_EQ(exit_code(unknown), 5);
    EXPECT_EQ(find_diagnostic_code("E9999"), nullptr);
}

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

TEST(DiagnosticList, ShowsTheLineAsATerminalCan) {
    const auto lines = [](const std::string& text) {
        const Source source{Source::Kind::file, 0, "a.toml", text};
        std::vector<std::string> shown;
        for (const int line : {1, 2, 3, 4})
            shown.push_back(source_range({&source, line, 1, 1}).line_text);
        return shown;
    };
    using Lines = std::vector<std::string>;
    EXPECT_EQ(lines("first\r\nsecond \u00b5\r\nlast"),
              (Lines{"first", "second \u00b5", "last", ""}));
    EXPECT_EQ(lines(std::string(5000, 'x') + "\n\x1b[31m\n\xff\n\tfine"),
              (Lines{"", "\\u001b[31m", "\\xff", "\tfine"}));
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
