// Damages the bytes of a file: the same seed gives the same damage everywhere.
#pragma once

#include <sys/resource.h>

#include <algorithm>
#include <cstdint>
#include <string>

#include "tests/io/files.h"

namespace skybake::testing {

inline std::size_t any_place(Random& random, std::size_t count) {
    return static_cast<std::size_t>(random.next() % count);
}

// Writes a number as VDB files hold lengths and positions, in 4 or 8 bytes.
inline void write_length(std::string& bytes, std::size_t at, std::uint64_t number,
                         std::size_t count) {
    for (std::size_t i = 0; i < count && at + i < bytes.size(); ++i) {
        bytes[at + i] = static_cast<char>(number >> 8 * i);
    }
}

// Returns the bytes with flipped bits, another length, an early end, or a part that is missing,
// doubled or zero.
inline std::string damaged(std::string bytes, std::uint64_t seed) {
    Random random(seed);
    const std::size_t at = any_place(random, bytes.size());
    const std::size_t count = 1 + any_place(random, std::min<std::size_t>(64, bytes.size() - at));
    switch (random.next() % 7) {
        case 0:  // many bits
            for (std::size_t i = 0; i < count; ++i) {
                char& byte = bytes[any_place(random, bytes.size())];
                byte = static_cast<char>(byte ^ 1 << random.next() % 8);
            }
            break;
        case 1:
            bytes.resize(at);
            break;
        case 2: {
            constexpr std::array<std::uint64_t, 6> numbers = {
                0, 1, 0x7fffffff, 0xffffffff, 0x7fffffffffffffff, 0x8000000000000000};
            const std::size_t size = random.next() % 2 == 0 ? 4 : 8;
            write_length(bytes, at, numbers[any_place(random, numbers.size())], size);
            break;
        }
        case 3:
            bytes.erase(at, count);
            break;
        case 4:
            bytes.insert(at, bytes.substr(at, count));
            break;
        case 5:
            std::fill_n(bytes.begin() + static_cast<std::ptrdiff_t>(at), count, '\0');
            break;
        default:  // one bit in the head, where lengths, names and transforms are
            bytes[at % 2000 % bytes.size()] =
                static_cast<char>(bytes[at % 2000 % bytes.size()] ^ 1 << random.next() % 8);
    }
    return bytes;
}

// The most memory that this process has had.
inline long peak_kib() {
    rusage usage{};
    ::getrusage(RUSAGE_SELF, &usage);
    return usage.ru_maxrss;
}

}  // namespace skybake::testing
