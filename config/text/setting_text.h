// The parts of KEY=VALUE texts of the command line.
#pragma once

#include <string_view>

namespace skybake::config {

// Without the blanks and tabs at both ends.
std::string_view trim(std::string_view text);

// Where the '=' between key and value stands: not one in the quotes of a name. npos if there is
// none.
std::size_t find_equals(std::string_view setting);

}  // namespace skybake::config
