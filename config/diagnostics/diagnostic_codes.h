// This header declares the one table of diagnostic codes, which codes.toml holds: what each code means,
// what to do about it, and the exit code of a run that ends with it.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "config/diagnostics/diagnostic.h"

namespace skybake::config {

struct DiagnosticCode {
    std::string code;         // "E0102"
    std::string title;        // "unknown key"
    std::string explanation;  // a paragraph
    std::string wrong;        // a text that causes the diagnostic; may be empty
    std::string right;        // the same text, corrected
    int exit_code = 2;        // 0 for warnings
};

// Returns the text of codes.toml, which is put into the binary when it is built.
std::string_view diagnostic_codes_toml();

std::span<const DiagnosticCode> diagnostic_codes();

// Returns null if there is no such code.
const DiagnosticCode* find_diagnostic_code(std::string_view code);

// Returns the exit code of a run that ends with these diagnostics: 0 if none is an error, else the
// greatest of the errors' exit codes. So a file that cannot be read (3) is not hidden by a misspelt
// key (2).
int exit_code(std::span<const Diagnostic> diagnostics);

}  // namespace skybake::config
