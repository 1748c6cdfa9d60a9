// Laying out paragraphs of plain text.
#pragma once

#include <string>
#include <string_view>

namespace skybake::config {

// Breaks text at blanks into lines of at most `width` characters, each behind the prefix and ended
// by a newline. Newlines in the text stay.
std::string wrap(std::string_view text, std::string_view prefix, std::size_t width);

}  // namespace skybake::config
