// Diagnostics about files.
#pragma once

#include <filesystem>
#include <string>
#include <system_error>
#include <utility>

#include "config/diagnostics/diagnostic.h"

namespace skybake {

inline config::Diagnostic file_error(std::string code, const std::string& file,
                                     std::string message) {
    config::Diagnostic diagnostic;
    diagnostic.code = std::move(code);
    diagnostic.message = std::move(message);
    diagnostic.where.source = file;
    return diagnostic;
}

// The system's words for an errno: "No space left on device".
inline std::string system_reason(int error) { return std::generic_category().message(error); }

}  // namespace skybake
