#include "bakers/io/manifest/release.h"

namespace skybake {

std::string_view tool_name() { return "skybake"; }
std::string_view release() { return SKYBAKE_RELEASE; }

}  // namespace skybake
