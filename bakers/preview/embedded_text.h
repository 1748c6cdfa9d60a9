// Texts that the program contains: shaders, scripts and pages.
#pragma once

#include <string_view>

namespace skybake {

// Returns the text of a file of bakers/preview/live or bakers/preview/runtime by its name, such as
// "live.html". Throws std::out_of_range where there is none.
std::string_view embedded_text(std::string_view name);

}  // namespace skybake
