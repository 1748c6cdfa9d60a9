// Hashes of bytes. Only hash.cpp includes xxHash.
#pragma once

#include <string>
#include <string_view>

struct XXH3_state_s;

namespace skybake {

// Returns the 128-bit XXH3 hash as 32 hexadecimal digits, most significant first, as `xxhsum -H2`
// prints it.
std::string xxh3_hex(std::string_view bytes);

// Computes the same hash of bytes that arrive piece by piece.
class Hasher {
  public:
    Hasher();
    ~Hasher();
    Hasher(const Hasher&) = delete;
    Hasher& operator=(const Hasher&) = delete;

    void update(std::string_view bytes);
    // Returns xxh3_hex of all bytes so far, joined.
    std::string hex() const;

  private:
    XXH3_state_s* state_;
};

}  // namespace skybake
