// This header declares the one table of diagnostic codes: what each code means, what to do about
// it, and the exit code of a run that ends with it. A code keeps its meaning for ever, and a
// retired number is not used again.
//
//   E00xx the command line     E01xx the recipe     E03xx files     E04xx checks of results
//   E05xx the program itself   W02xx warnings
#pragma once

#include <span>
#include <string_view>

#include "config/diagnostics/diagnostic.h"

namespace skybake::config {

struct DiagnosticCode {
    std::string_view code;         // "E0102"
    std::string_view title;        // "unknown key"
    std::string_view explanation;  // a paragraph
    std::string_view wrong;        // a text that causes the diagnostic; may be empty
    std::string_view right;        // the same text, corrected
    int exit_code = 2;             // 0 for warnings
};

std::span<const DiagnosticCode> diagnostic_codes();

// Returns null if there is no such code.
const DiagnosticCode* find_diagnostic_code(std::string_view code);

// Returns the exit code of a run that ends with these diagnostics: 0 if none is an error, else the
// greatest of the errors' exit codes. So a file that cannot be read (3) is not hidden by a misspelt
// key (2).
int exit_code(std::span<const Diagnostic> diagnostics);

}  // namespace skybake::config
