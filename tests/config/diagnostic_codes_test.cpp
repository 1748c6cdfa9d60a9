#include "config/diagnostics/diagnostic_codes.h"

#include <gtest/gtest.h>

#include <map>
#include <set>
#include <vector>

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

}  // namespace
}  // namespace skybake::config
