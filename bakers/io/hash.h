// Fingerprints of bytes. hash.cpp alone knows xxHash.
#pragma once

#include <string>
#include <string_view>

namespace skybake {

// XXH3 with 128 bits as 32 hexadecimal digits, most significant first (what `xxhsum -H2` prints).
std::string xxh3_hex(std::string_view bytes);

}  // namespace skybake
