// Amounts of memory and disk, for people.
#pragma once

#include <string>

namespace skybake {

// "12 B", "190 KiB", "1.5 GiB".
std::string byte_size_text(double bytes);

}  // namespace skybake
