#include "cli/byte_size.h"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <cmath>

#include "cli/parse_arguments.h"
#include "config/text/key_path.h"

namespace skybake::cli {
namespace {

struct Unit {
    std::string_view name;
    double bytes;
};

constexpr std::array units = {
    Unit{"", 1},
    Unit{"B", 1},
    Unit{"K", 1024.0},
    Unit{"M", 1024.0 * 1024},
    Unit{"G", 1024.0 * 1024 * 1024},
    Unit{"T", 1024.0 * 1024 * 1024 * 1024},
    Unit{"KiB", 1024.0},
    Unit{"MiB", 1024.0 * 1024},
    Unit{"GiB", 1024.0 * 1024 * 1024},
    Unit{"TiB", 1024.0 * 1024 * 1024 * 1024},
    Unit{"kB", 1e3},
    Unit{"MB", 1e6},
    Unit{"GB", 1e9},
    Unit{"TB", 1e12},
};

}  // namespace

std::optional<std::uint64_t> parse_byte_size(std::string_view text) {
    double number = 0;
    const char* const end = text.data() + text.size();
    const auto [after, error] = std::from_chars(text.data(), end, number, std::chars_format::fixed);
    if (error != std::errc{} || !(number >= 0)) return std::nullopt;
    std::string_view unit(after, static_cast<std::size_t>(end - after));
    if (!unit.empty() && unit.front() == ' ') unit.remove_prefix(1);
    for (const Unit& known : units) {
        if (unit != known.name) continue;
        const double bytes = std::ceil(number * known.bytes);
        if (!(bytes <= 0x1p63)) return std::nullopt;
        return static_cast<std::uint64_t>(bytes);
    }
    return std::nullopt;
}

config::Diagnostic byte_size_error(std::string_view option, std::string_view text) {
    return usage_error(fmt::format("`{}` cannot be `{}`", option, config::shorten(text)),
                       "it takes a size such as 512M, 2GiB or 2GB");
}

}  // namespace skybake::cli
