// The lines that --json prints on stdout; event_schema.json describes them.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>
#include <string_view>

#include "cli/exit_code.h"
#include "config/diagnostics/diagnostic.h"

namespace skybake::cli {

// One event as one line. Bytes that are not UTF-8 become U+FFFD.
std::string event_line(const nlohmann::ordered_json& event);

// The last line of a run that failed. `command` is empty where none was understood.
std::string failed_event(std::string_view command, ExitCode code,
                         std::span<const config::Diagnostic> diagnostics);

}  // namespace skybake::cli
