// Is a text UTF-8?
#pragma once

#include <optional>
#include <string_view>

namespace skybake::config {

// The offset of the first byte that is no UTF-8 (overlong forms, surrogates and values above
// U+10FFFF included) or is a NUL; none if all is well.
std::optional<std::size_t> find_invalid_utf8(std::string_view text);

}  // namespace skybake::config
