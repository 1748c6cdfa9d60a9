// Whole files into memory, with one clear diagnostic where that does not work.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "config/diagnostics/diagnostic.h"

namespace skybake {

// E0300: missing, a folder, a device or pipe, not permitted, larger than `limit` bytes, or an error
// while reading; the message says which.
config::Outcome<std::string> read_file(const std::filesystem::path& path,
                                       std::uintmax_t limit = std::uintmax_t{4} << 30);

}  // namespace skybake
