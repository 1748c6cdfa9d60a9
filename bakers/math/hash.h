// Fingerprints of bytes. hash.cpp alone knows xxHash.
#pragma once

#include <memory>
#include <string>
#include <string_view>

namespace skybake {

// XXH3 with 128 bits as 32 hexadecimal digits, most significant first (what `xxhsum -H2` prints).
std::string xxh3_hex(std::string_view bytes);

// The same of bytes that come piece by piece.
class Hasher {
  public:
    Hasher();
    ~Hasher();
    Hasher(const Hasher&) = delete;
    Hasher& operator=(const Hasher&) = delete;

    void update(std::string_view bytes);
    // xxh3_hex of all bytes so far, joined.
    std::string hex() const;

  private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace skybake
