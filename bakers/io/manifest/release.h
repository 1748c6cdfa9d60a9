// The name and number of this release, as files and manifests carry them.
#pragma once

#include <string_view>

namespace skybake {

std::string_view tool_name();  // "skybake"
std::string_view release();    // "0.1.0"

}  // namespace skybake
