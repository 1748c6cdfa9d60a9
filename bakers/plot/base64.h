// Bytes as text, for data: URIs.
#pragma once

#include <string>
#include <string_view>

namespace skybake {

// RFC 4648, section 4, with padding.
std::string base64(std::string_view bytes);

}  // namespace skybake
