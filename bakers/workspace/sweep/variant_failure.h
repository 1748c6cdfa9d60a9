// error.json: why a variant could not be made, in its folder until it can.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "config/diagnostics/diagnostic.h"

namespace skybake {

inline constexpr std::string_view failure_name = "error.json";

// Its text: the errors among the diagnostics.
std::string failure_json(const std::vector<config::Diagnostic>& diagnostics);

// The errors of a folder's error.json; none if there is none, or it is damaged.
std::vector<config::Diagnostic> read_failure(const std::filesystem::path& folder);

// Writes the errors into the variant's folder, which is made where it is missing. E0301, E0302.
std::vector<config::Diagnostic> write_failure(const std::filesystem::path& folder,
                                              const std::vector<config::Diagnostic>& diagnostics);

// Takes it away, if it is there.
void remove_failure(const std::filesystem::path& folder);

}  // namespace skybake
