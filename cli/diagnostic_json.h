// Diagnostics as JSON, for diagnostic_printer.cpp.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>

#include "config/diagnostics/diagnostic.h"

namespace skybake::cli {

// Whether a diagnostic's source names a file. "--set `a.b=c`", "--vary `a.b=1,2`", "preset earth"
// and "<stdin>" are sources, but an editor can open none of them.
bool is_file(const std::string& source);

// An array of objects: severity, code, message, label, and as far as they are known file, line,
// column and length. Columns count code points from 1. Where the source is no file, `source` names
// it, and lines are given of standard input alone.
nlohmann::ordered_json diagnostics_json(std::span<const config::Diagnostic> diagnostics);

// The same objects, one per line.
std::string print_json_lines(std::span<const config::Diagnostic> diagnostics);

// One SARIF 2.1.0 document, which code scanning services read.
std::string print_sarif(std::span<const config::Diagnostic> diagnostics);

}  // namespace skybake::cli
