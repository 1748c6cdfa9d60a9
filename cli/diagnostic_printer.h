// This header prints diagnostics as text, for people and for four kinds of machine. Its functions
// are pure.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "config/diagnostics/diagnostic.h"

namespace skybake::cli {

enum class DiagnosticFormat {
    human,   // message, place, line with carets, and a count at the end
    short_,  // one line each: earth.toml:14:1: error[E0102]: unknown key ...
    json,    // one JSON object per line
    github,  // workflow commands, shown beside the lines of a pull request
    sarif,   // one SARIF 2.1.0 document
};

// Returns "error" or "warning".
std::string_view severity_word(const Diagnostic& diagnostic);

// Returns the text. It ends in a newline. Without diagnostics it is empty, except for SARIF, which
// then is a document without results. `color` only matters to `human`.
std::string print_diagnostics(std::span<const Diagnostic> diagnostics, DiagnosticFormat format,
                              bool color = false);

}  // namespace skybake::cli
