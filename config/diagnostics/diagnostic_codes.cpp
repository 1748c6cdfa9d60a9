#include "config/diagnostics/diagnostic_codes.h"

#include <algorithm>
#include <vector>

#include "config/diagnostics/code_tables.h"

namespace skybake::config {
namespace {

std::vector<DiagnosticCode> joined_tables() {
    std::vector<DiagnosticCode> all;
    for (const auto& table :
         {text_codes(), section_codes(), asset_codes(), run_codes(), warning_codes()}) {
        all.insert(all.end(), table.begin(), table.end());
    }
    return all;
}

}  // namespace

std::span<const DiagnosticCode> diagnostic_codes() {
    static const std::vector<DiagnosticCode> all = joined_tables();
    return all;
}

const DiagnosticCode* find_diagnostic_code(std::string_view code) {
    for (const DiagnosticCode& entry : diagnostic_codes()) {
        if (entry.code == code) return &entry;
    }
    return nullptr;
}

int exit_code(std::span<const Diagnostic> diagnostics) {
    int result = 0;
    for (const Diagnostic& diagnostic : diagnostics) {
        if (diagnostic.severity != Severity::error) continue;
        const DiagnosticCode* code = find_diagnostic_code(diagnostic.code);
        result = std::max(result, code ? code->exit_code : internal);
    }
    return result;
}

}  // namespace skybake::config
