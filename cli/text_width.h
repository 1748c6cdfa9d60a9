// How wide UTF-8 text is in a terminal.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace skybake::cli {

// The code point at `position`, which moves behind it. A byte that is not UTF-8 counts as U+FFFD.
std::uint32_t next_code_point(std::string_view text, std::size_t& position);

// Columns of one code point: 0 for combining marks, 2 for wide East Asian signs and emoji, else 1.
int code_point_width(std::uint32_t code_point);

// Columns of a text without tabs and newlines.
int text_width(std::string_view text);

}  // namespace skybake::cli
