// What programs read: the events that --json prints on stdout, and diagnostics as JSON and SARIF.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>
#include <string_view>

#include "cli/console.h"
#include "config/diagnostics/diagnostic.h"

namespace skybake::cli {

// One event as one line. Bytes that are not UTF-8 become U+FFFD.
std::string event_line(const nlohmann::ordered_json& event);

// The last line of a run that failed. `command` is empty where none was understood.
std::string failed_event(std::string_view command, ExitCode code,
                         std::span<const config::Diagnostic> diagnostics);

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

// The JSON Schema of all events: event_schema.json.
std::string event_schema();

}  // namespace skybake::cli
