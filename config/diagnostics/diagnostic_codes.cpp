#include "config/diagnostics/diagnostic_codes.h"

#include <algorithm>
#include <cassert>
#include <vector>

#include "config/diagnostics/toml_source.h"

namespace skybake::config {
namespace {

constexpr int usage = 2;
constexpr int input_or_output = 3;
constexpr int failed_check = 4;
constexpr int internal = 5;

int exit_code_of(std::string_view code) {
    if (code.starts_with('W')) return 0;
    if (code.starts_with("E00") || code.starts_with("E01")) return usage;
    if (code.starts_with("E03")) return input_or_output;
    return code.starts_with("E04") ? failed_check : internal;
}

std::vector<DiagnosticCode> read_codes() {
    const Source source{.name = "codes.toml", .text = std::string(diagnostic_codes_toml())};
    DiagnosticList errors;
    const std::optional<Table> table = parse_toml(source, errors);
    assert(table && "config/diagnostics/codes.toml is TOML");
    std::vector<DiagnosticCode> codes;
    for (const Entry& entry : *table) {
        const Table& code = *as_table(entry.value);
        const auto words = [&](std::string_view key) {
            const std::string* text = find_text(code, key);
            return text ? *text : std::string();
        };
        std::string paragraph = words("text");
        std::ranges::replace(paragraph, '\n', ' ');
        codes.push_back({entry.key, words("title"), std::move(paragraph), words("wrong"),
                         words("right"), exit_code_of(entry.key)});
    }
    return codes;
}

}  // namespace

std::span<const DiagnosticCode> diagnostic_codes() {
    static const std::vector<DiagnosticCode> all = read_codes();
    return all;
}

const DiagnosticCode* find_diagnostic_code(std::string_view code) {
    const auto found = std::ranges::find(diagnostic_codes(), code, &DiagnosticCode::code);
    return found == diagnostic_codes().end() ? nullptr : &*found;
}

int exit_code(std::span<const Diagnostic> diagnostics) {
    int result = 0;
    for (const Diagnostic& diagnostic : diagnostics) {
        if (diagnostic.severity == Severity::error) {
            result = std::max(result, exit_code_of(diagnostic.code));
        }
    }
    return result;
}

}  // namespace skybake::config
