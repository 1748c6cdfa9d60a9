// Amounts of memory and disk, as people write them on the command line.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "config/diagnostics/diagnostic.h"

namespace skybake::cli {

// "512MiB", "2G", "1.5 GB", "4096" (bytes): KiB, MiB, GiB, TiB are powers of 1024, and so are K, M,
// G, T alone, as in Slurm and systemd; kB, MB, GB, TB are powers of 1000. None for anything else,
// also for more than 2^63 bytes.
std::optional<std::uint64_t> parse_byte_size(std::string_view text);

// E0001 that says what is allowed.
config::Diagnostic byte_size_error(std::string_view option, std::string_view text);

}  // namespace skybake::cli
