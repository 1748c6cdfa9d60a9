#include "cli/event_line.h"

#include <nlohmann/json.hpp>

#include "cli/diagnostic_json.h"

namespace skybake::cli {

using Json = nlohmann::ordered_json;

std::string event_line(const Json& event) {
    return event.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string failed_event(std::string_view command, ExitCode code,
                         std::span<const config::Diagnostic> diagnostics) {
    return event_line({{"event", "failed"},
                       {"command", command},
                       {"exit_code", static_cast<int>(code)},
                       {"diagnostics", diagnostics_json(diagnostics)}});
}

}  // namespace skybake::cli
