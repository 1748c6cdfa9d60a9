// Diagnostics as JSON, for diagnostic_printer.cpp.
#pragma once

#include <span>
#include <string>

#include "config/diagnostic.h"

namespace skybake::cli {

// One object a line: severity, code, message, file, line, column, length, label. Columns count code
// points from 1; line and column are 0 where they are not known.
std::string print_json_lines(std::span<const config::Diagnostic> diagnostics);

// One SARIF 2.1.0 document, which code scanning services read.
std::string print_sarif(std::span<const config::Diagnostic> diagnostics);

}  // namespace skybake::cli
