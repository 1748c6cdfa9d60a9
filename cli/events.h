// This header makes what programs read: the events that --json prints on stdout, and diagnostics as
// JSON and SARIF.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>
#include <string_view>

#include "cli/console.h"
#include "config/diagnostics/diagnostic.h"

namespace skybake::cli {

// Spells one event as one line. Bytes that are not UTF-8 become U+FFFD.
std::string event_line(const nlohmann::ordered_json& event);

// Returns the last line of a run that failed. `command` is empty if no command was understood.
std::string failed_event(std::string_view command, ExitCode code,
                         std::span<const Diagnostic> diagnostics);

// Whether a diagnostic's source names a file. "--set `a.b=c`", "--vary `a.b=1,2`", "preset earth"
// and "<stdin>" are sources, but an editor can open none of them.
bool is_file(const std::string& source);

// Returns an array of objects with severity, code, message and label, and, as far as they are
// known, file, line, column and length. Columns count code points from 1. If the source is not a
// file, `source` names it; of such sources only standard input has lines.
nlohmann::ordered_json diagnostics_json(std::span<const Diagnostic> diagnostics);

// Returns the same objects, one per line.
std::string print_json_lines(std::span<const Diagnostic> diagnostics);

// Returns one SARIF 2.1.0 document, which code scanning services read.
std::string print_sarif(std::span<const Diagnostic> diagnostics);

}  // namespace skybake::cli
